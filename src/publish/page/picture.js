// Every splat is a square with a Gaussian in it, added to a picture of floats, which is finished as
// the scene says (docs/finish.md of splotchcl). Light adds up in any order; where splats absorb, they
// are drawn from the farthest on, and each takes from what lies behind it.
const splat_shader = `#version 300 es
precision highp float;
layout(location = 0) in float code_x;
layout(location = 1) in float code_y;
layout(location = 2) in float code_z;
layout(location = 3) in float code_sigma;
layout(location = 4) in float code_red;
layout(location = 5) in float code_green;
layout(location = 6) in float code_blue;
layout(location = 7) in float code_depth_red;
layout(location = 8) in float code_depth_green;
layout(location = 9) in float code_depth_blue;
uniform vec3 lower, upper, eye, right, down, forward;
uniform vec2 sigma_range, light_range, depth_range, size;
uniform float focal, flat_scale, footprint2, least, white;
flat out vec3 light, optical_depth;
out vec2 place;
float value_of(float code, vec2 range) {
  return code == 0.0 ? 0.0 : exp2(mix(range.x, range.y, (code * 65535.0 - 1.0) / 65534.0));
}
void main() {
  vec3 from = mix(lower, upper, vec3(code_x, code_y, code_z)) - eye;
  float depth = dot(from, forward);
  float sigma = exp2(mix(sigma_range.x, sigma_range.y, code_sigma));
  // What is around the camera fades, as far as a splat can show it.
  float seen = flat_scale > 0.0 ? step(0.0, depth) : smoothstep(0.25, 1.5, depth / sigma);
  float scale = flat_scale > 0.0 ? flat_scale : focal / max(depth, 1e-3 * sigma);
  float own2 = sigma * scale * sigma * scale;
  float drawn2 = own2 + 2.0 * footprint2;
  float part = own2 / drawn2 * seen;
  light = part * vec3(value_of(code_red, light_range), value_of(code_green, light_range),
                      value_of(code_blue, light_range));
  optical_depth = part * vec3(value_of(code_depth_red, depth_range), value_of(code_depth_green, depth_range),
                              value_of(code_depth_blue, depth_range));
  // What it adds, or takes from white.
  vec3 most = max(light, white * optical_depth);
  float brightest = max(most.r, max(most.g, most.b));
  float reach = sqrt(max(log(brightest / least), 0.0));
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  place = corner * reach;
  vec2 pixel = vec2(dot(from, right), -dot(from, down)) * scale + corner * reach * sqrt(drawn2);
  gl_Position = brightest > least ? vec4(pixel / (0.5 * size), 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}`;
const light_shader = `#version 300 es
precision highp float;
flat in vec3 light;
in vec2 place;
out vec4 added;
void main() { added = vec4(light * exp(-dot(place, place)), 0.0); }`;

// L becomes L exp(-A X) + E X phi(A X). What is left of L is in the fourth number, for the channel
// that is drawn.
const veil_shader = `#version 300 es
precision highp float;
flat in vec3 light, optical_depth;
in vec2 place;
uniform vec3 channel;
out vec4 added;
void main() {
  float column = exp(-dot(place, place));
  vec3 depth = optical_depth * column, through = exp(-depth);
  // Of small depths a difference from 1 is rounding.
  vec3 phi = mix((1.0 - through) / max(depth, 1e-9), 1.0 - 0.5 * depth, lessThan(depth, vec3(1e-3)));
  added = vec4(light * column * phi, dot(through, channel));
}`;

const whole_shader = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;

// Sums become light: I = B + S, or q (1 - exp(-S / q)) + B exp(-S / q).
const resolve_shader = `#version 300 es
precision highp float;
uniform sampler2D sums;
uniform vec3 background;
uniform float source;
out vec4 light;
void main() {
  vec3 s = texelFetch(sums, ivec2(gl_FragCoord.xy), 0).rgb;
  vec3 through = source > 0.0 ? exp(-s / source) : vec3(1.0);
  vec3 own = source > 0.0 ? source * (1.0 - through) : s;
  light = vec4(min(background * through + own, 6e4), 1.0);  // the most that a half holds is 65504
}`;

// One axis of a bell, at most 16 texels wide to each side.
const blur_shader = `#version 300 es
precision highp float;
uniform sampler2D light;
uniform vec2 axis, target;
uniform float deviation;
out vec4 blurred;
void main() {
  vec2 size = vec2(textureSize(light, 0));
  vec2 at = gl_FragCoord.xy * (size / target);
  vec3 sum = vec3(0.0);
  float all = 0.0;
  for (int i = -16; i <= 16; ++i) {
    float weight = exp(-0.5 * float(i * i) / (deviation * deviation));
    sum += weight * texture(light, (at + float(i) * axis) / size).rgb;
    all += weight;
  }
  blurred = vec4(sum / all, 1.0);
}`;

const finish_shader = `#version 300 es
precision highp float;
uniform sampler2D light, bloom_1, bloom_2, bloom_3;
uniform vec2 size;
uniform mat3 balance;
uniform float bloom, gain, white, highlights, saturation, contrast, pivot, gamma;
uniform int tone;
out vec4 shown;
float filmic(float x) {
  return (x * (0.22 * x + 0.03) + 0.002) / (x * (0.22 * x + 0.3) + 0.06) - 0.01 / 0.3;
}
float curve(float x) {
  if (tone == 1) return asinh(10.0 * x) / asinh(10.0 * white);
  if (tone == 2) return filmic(x) / filmic(white);
  return x / white;
}
void main() {
  vec2 at = gl_FragCoord.xy / size;
  vec3 l = texture(light, at).rgb;
  if (bloom > 0.0) {
    vec3 scattered = texture(bloom_1, at).rgb + texture(bloom_2, at).rgb + texture(bloom_3, at).rgb;
    l = mix(l, scattered / 3.0, bloom);
  }
  l = max(balance * (l * gain), 0.0);
  float brightest = max(l.r, max(l.g, l.b));
  if (brightest > 0.0) {
    float t = curve(brightest);
    l *= t / brightest;
    float to_white = highlights * pow(min(t, 1.0), 4.0);
    l += to_white * (t - l);
  }
  float luminance = dot(l, vec3(0.2126, 0.7152, 0.0722));
  l = max(luminance + saturation * (l - luminance), 0.0);
  l = pow(l, vec3(1.0 / gamma));
  l = pivot * pow(l / pivot, vec3(contrast));
  shown = vec4(min(l, 1.0), 1.0);
}`;

class Picture {
  constructor(canvas, settings, columns) {
    this.canvas = canvas;
    this.settings = settings;
    const gl = canvas.getContext("webgl2", {alpha: false, antialias: false, preserveDrawingBuffer: true});
    if (!gl) throw new Error("This browser does not draw with WebGL 2.");
    this.gl = gl;
    // Sums of floats, or where these do not add up, of halves.
    const floats = gl.getExtension("EXT_color_buffer_float");
    this.has_floats = Boolean(floats && gl.getExtension("EXT_float_blend"));
    if (!floats && !gl.getExtension("EXT_color_buffer_half_float"))
      throw new Error("This browser's WebGL does not draw into pictures of floats.");
    this.adds = this.program(splat_shader, settings.splats.depths ? veil_shader : light_shader);
    this.resolves = this.program(whole_shader, resolve_shader);
    this.blurs = this.program(whole_shader, blur_shader);
    this.finishes = this.program(whole_shader, finish_shader);
    this.splats = gl.createVertexArray();
    gl.bindVertexArray(this.splats);
    this.buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, columns, gl.STATIC_DRAW);
    const {count, depths} = settings.splats;
    this.order = depths ? new Order(columns, settings.splats) : null;
    for (let i = 0; i < (depths ? 10 : 7); ++i) {
      // One depth may be that of all channels.
      const column = depths === 1 ? Math.min(i, 7) : i;
      const [step, first] = depths ? [4 * this.order.words, 2 * column] : [2, 2 * count * column];
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, 1, gl.UNSIGNED_SHORT, true, step, first);
      gl.vertexAttribDivisor(i, 1);
    }
    this.nothing = gl.createVertexArray();
    this.targets = [];
  }

  program(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error("A shader does not compile: " + gl.getProgramInfoLog(program));
    const places = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
      const {name} = gl.getActiveUniform(program, i);
      places[name] = gl.getUniformLocation(program, name);
    }
    return {program, places};
  }

  // With levels, for others to take means of.
  target(width, height, has_floats, levels = 1) {
    const gl = this.gl, texture = gl.createTexture(), frame = gl.createFramebuffer();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, levels, has_floats ? gl.RGBA32F : gl.RGBA16F, width, height);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
      gl.texParameteri(gl.TEXTURE_2D, side, gl.MIRRORED_REPEAT);
    const filter = has_floats ? gl.NEAREST : gl.LINEAR;
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER,
                     levels > 1 ? gl.LINEAR_MIPMAP_LINEAR : filter);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    const made = {texture, frame, width, height};
    this.targets.push(made);
    return made;
  }

  resize(width, height) {
    if (this.width === width && this.height === height) return;
    const gl = this.gl;
    for (const {texture, frame} of this.targets) {
      gl.deleteTexture(texture);
      gl.deleteFramebuffer(frame);
    }
    this.targets = [];
    Object.assign(this, {width, height});
    this.canvas.width = width;
    this.canvas.height = height;
    this.sums = this.target(width, height, this.has_floats);
    this.light = this.target(width, height, false, 1 + Math.floor(Math.log2(Math.max(width, height))));
    // Bells are drawn where they are a few texels wide.
    this.bells = [1 / 360, 1 / 90, 2 / 45].map((part) => {
      const deviation = part * Math.min(width, height);
      const coarser = Math.max(1, deviation / 4);
      const w = Math.max(1, Math.round(width / coarser)), h = Math.max(1, Math.round(height / coarser));
      return {deviation: deviation * w / width, across: this.target(w, h, false), both: this.target(w, h, false)};
    });
  }

  // Draws into the target, or onto the canvas.
  pass({program, places}, target, values, textures = {}) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target ? target.frame : null);
    gl.viewport(0, 0, target ? target.width : this.width, target ? target.height : this.height);
    gl.useProgram(program);
    for (const [name, value] of Object.entries(values)) {
      if (places[name] === undefined) continue;
      if (name === "tone") gl.uniform1i(places[name], value);
      else if (typeof value === "number") gl.uniform1f(places[name], value);
      else if (value.length === 9) gl.uniformMatrix3fv(places[name], false, value);
      else gl[`uniform${value.length}fv`](places[name], value);
    }
    Object.entries(textures).forEach(([name, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture.texture);
      if (places[name] !== undefined) gl.uniform1i(places[name], unit);
    });
    if (program === this.adds.program) {
      this.draw_splats(places.channel);
    } else {
      gl.bindVertexArray(this.nothing);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
  }

  draw_splats(channel) {
    const gl = this.gl, {count, depths} = this.settings.splats;
    const [red, green, blue] = depths ? this.settings.background : [0, 0, 0];
    gl.clearColor(red, green, blue, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.bindVertexArray(this.splats);
    if (!depths) {
      gl.blendFunc(gl.ONE, gl.ONE);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    }
    // Blending knows one number that all channels are multiplied by: where they differ, each is drawn
    // by itself.
    if (depths) gl.blendFunc(gl.ONE, gl.SRC_ALPHA);
    for (let drawn = 0; drawn < depths; ++drawn) {
      const is_drawn = [0, 1, 2].map((c) => depths === 1 || c === drawn);
      gl.colorMask(...is_drawn, false);
      gl.uniform3fv(channel, [0, 1, 2].map((c) => Number(c === drawn)));
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    }
    gl.colorMask(true, true, true, true);
    gl.disable(gl.BLEND);
  }

  put_in_order(forward) {
    const rows = this.order ? this.order.rows_along(forward) : null;
    if (!rows) return;
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, rows, this.gl.DYNAMIC_DRAW);
  }

  draw(camera, width, height) {
    this.resize(width, height);
    const {splats, finish, footprint} = this.settings;
    // Where splats absorb, the background lies behind them already.
    const {background, source} = this.order ? {background: [0, 0, 0], source: 0} : this.settings;
    this.put_in_order(camera.axes.forward);
    const white = finish.white / finish.gain;
    const focal = camera.focal(width, height);
    this.pass(this.adds, this.sums, {
      ...camera.axes, eye: camera.position(), focal,
      flat_scale: this.settings.camera.flat ? focal / camera.distance : 0,
      lower: splats.lower, upper: splats.upper, sigma_range: splats.sigma, light_range: splats.light,
      depth_range: splats.depth, white,
      size: [width, height], footprint2: footprint * footprint,
      least: finish.least * white,
    });
    this.pass(this.resolves, this.light, {background, source}, {sums: this.sums});
    if (finish.bloom > 0) {
      const gl = this.gl;
      gl.bindTexture(gl.TEXTURE_2D, this.light.texture);
      gl.generateMipmap(gl.TEXTURE_2D);
      for (const {deviation, across, both} of this.bells) {
        const target = [across.width, across.height];
        const step = [this.light.width / across.width, 0];
        this.pass(this.blurs, across, {axis: step, deviation, target}, {light: this.light});
        this.pass(this.blurs, both, {axis: [0, 1], deviation, target}, {light: across});
      }
    }
    const [bloom_1, bloom_2, bloom_3] = this.bells.map((bell) => bell.both);
    this.pass(this.finishes, null, {...finish, size: [width, height]},
              {light: this.light, bloom_1, bloom_2, bloom_3});
  }
}
