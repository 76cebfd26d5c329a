// What one does to the page, and the pictures that follow.
const element = (id) => document.getElementById(id);
const settings = JSON.parse(element("settings").textContent);
const canvas = element("picture");
const camera = new Camera(settings.camera);
let picture = null, is_asked = false, coarser = 1, settle = 0;

async function unpacked() {
  const bytes = Uint8Array.from(atob(element("splats").textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = settings.splats.count, wide = 7 + settings.splats.depths;
  const columns = new Uint16Array(wide * count);
  for (let column = 0; column < wide; ++column) {
    for (let i = 0; i < count; ++i) {
      const at = 2 * column * count + i;
      columns[column * count + i] = planes[at] | planes[at + count] << 8;
    }
  }
  return columns;
}

const ratio = () => Math.min(window.devicePixelRatio || 1, 2);

function draw() {
  is_asked = false;
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio() / coarser));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio() / coarser));
  picture.draw(camera, width, height);
  draw_scale();
  document.documentElement.dataset.drawn = String(1 + Number(document.documentElement.dataset.drawn || 0));
}

function ask() {
  if (!picture || is_asked) return;
  is_asked = true;
  requestAnimationFrame(draw);
}

// While one moves pictures are as coarse as keeps up with the hand, and exact when one rests.
let last_move = 0;
function moved() {
  const now = performance.now(), gap = now - last_move;
  last_move = now;
  if (gap < 400 && gap > 60) coarser = Math.min(4, coarser * 1.5);
  ask();
  clearTimeout(settle);
  settle = setTimeout(() => { if (coarser > 1) { coarser = 1; ask(); } }, 250);
}

function draw_scale() {
  const length = camera.distance / camera.focal(canvas.clientWidth, canvas.clientHeight);
  const most = length * Math.min(0.25 * canvas.clientWidth, 220);
  const power = 10 ** Math.floor(Math.log10(most));
  const round = [5, 2, 1].map((digit) => digit * power).find((value) => value <= most);
  element("bar").style.width = `${round / length}px`;
  element("length").textContent = `${Number(round.toPrecision(2))} ${settings.unit}`.trim();
}

// Pointers by their numbers: one turns, two come closer and move.
const pointers = new Map();
const middle = () => [...pointers.values()].reduce(([x, y], p) => [x + p.x / pointers.size, y + p.y / pointers.size], [0, 0]);
const apart = () => {
  const [a, b] = [...pointers.values()];
  return Math.hypot(a.x - b.x, a.y - b.y);
};
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
});
for (const end of ["pointerup", "pointercancel"])
  canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
canvas.addEventListener("pointermove", (event) => {
  if (!pointers.has(event.pointerId)) return;
  const [x, y] = middle(), before = pointers.size > 1 ? apart() : 0;
  pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  const [to_x, to_y] = middle(), dx = to_x - x, dy = to_y - y;
  if (pointers.size > 1 || event.shiftKey || event.buttons & 2) {
    camera.move(dx, dy, camera.focal(canvas.clientWidth, canvas.clientHeight));
    if (before > 0) camera.approach(before / Math.max(apart(), 1));
  } else {
    const per_pixel = 4 / Math.min(canvas.clientWidth, canvas.clientHeight);
    camera.turn(dx * per_pixel, -dy * per_pixel);
  }
  moved();
});
canvas.addEventListener("contextmenu", (event) => event.preventDefault());
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  camera.approach(Math.exp(Math.max(-200, Math.min(200, event.deltaY)) * 1.5e-3));
  moved();
}, {passive: false});
canvas.addEventListener("dblclick", () => { camera.reset(); moved(); });
const keys = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]};
canvas.addEventListener("keydown", (event) => {
  if (keys[event.key]) camera.turn(...keys[event.key]);
  else if (event.key === "+" || event.key === "=") camera.approach(0.8);
  else if (event.key === "-") camera.approach(1.25);
  else return;
  event.preventDefault();
  moved();
});
element("reset").addEventListener("click", () => { camera.reset(); moved(); });
element("full").addEventListener("click", () => {
  if (document.fullscreenElement) document.exitFullscreen();
  else document.documentElement.requestFullscreen();
});
element("full").hidden = !document.fullscreenEnabled;
element("open-about").addEventListener("click", () => element("about").showModal());
for (const fact of settings.about) {
  const paragraph = document.createElement("p");
  paragraph.textContent = fact;
  element("facts").append(paragraph);
}
window.addEventListener("resize", ask);

function fail(error) {
  element("failure").hidden = false;
  element("failure").textContent = `The picture cannot be drawn here. ${error.message}`;
}
canvas.addEventListener("webglcontextlost", (event) => {
  event.preventDefault();
  picture = null;
});
const start = () => unpacked().then((columns) => {
  picture = new Picture(canvas, settings, columns);
  ask();
}).catch(fail);
canvas.addEventListener("webglcontextrestored", start);
start();
