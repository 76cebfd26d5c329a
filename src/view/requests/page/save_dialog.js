// Saves the scene or the picture where the program runs, after showing what has changed; or gives
// the browser the scene, or the picture that the page shows.
import {element} from './elements.js';

// Which lines two texts do not have in common, by their longest common subsequence: a list of
// [sign, line] with the signs '-', '+' and ' '.
function lineChanges(before, after) {
  const a = before.split('\n'), b = after.split('\n');
  const common = Array.from({length: a.length + 1}, () => new Uint32Array(b.length + 1));
  for (let i = a.length - 1; i >= 0; --i) {
    for (let j = b.length - 1; j >= 0; --j) {
      common[i][j] = a[i] === b[j] ? common[i + 1][j + 1] + 1
                                   : Math.max(common[i + 1][j], common[i][j + 1]);
    }
  }
  const lines = [];
  let i = 0, j = 0;
  while (i < a.length || j < b.length) {
    if (i < a.length && j < b.length && a[i] === b[j]) {
      lines.push([' ', a[i]]);
      ++i, ++j;
    } else if (j >= b.length || (i < a.length && common[i + 1][j] >= common[i][j + 1])) {
      lines.push(['-', a[i++]]);
    } else {
      lines.push(['+', b[j++]]);
    }
  }
  return lines;
}

const byId = (id) => document.getElementById(id);

export class SaveDialog {
  constructor(link, opened, canvas) {
    this.link = link;
    this.canvas = canvas;
    this.paths = {save_scene: opened.scene_file, save_picture: opened.picture_file};
    this.dialog = byId('save-dialog');
    byId('save-close').onclick = () => this.dialog.close();
    this.dialog.querySelector('form').onsubmit = (event) => {
      event.preventDefault();
      this.save();
    };
    byId('save-download').onclick = () => this.download();
    byId('save-path').oninput = () => this.mayReplace(false);
  }

  open(type) {
    const isScene = type === 'save_scene';
    this.type = type;
    byId('save-title').textContent = isScene ? 'Save scene' : 'Save picture';
    byId('save-path').value = this.paths[type];
    byId('save-note').textContent = isScene
      ? 'A scene file (.toml) in the folder in which splotchcl runs, or a path. splotchcl render draws it as it is here.'
      : 'Drawn anew by splotchcl as .png, .jpg, .exr or .tif, in the folder in which it runs, or at a path.';
    byId('save-answer').textContent = '';
    byId('save-changes').hidden = !isScene;
    this.mayReplace(false);
    this.dialog.showModal();
    if (isScene) this.showChanges();
  }

  async showChanges() {
    const shown = byId('save-diff');
    shown.textContent = '';
    try {
      const {opened, now} = await this.link.ask({type: 'scene_text'});
      const changes = lineChanges(opened, now).filter(([sign]) => sign !== ' ');
      if (changes.length === 0) shown.textContent = 'nothing';
      for (const [sign, line] of changes) {
        shown.append(element(sign === '+' ? 'ins' : 'del', {}, `${sign} ${line}\n`));
      }
    } catch (error) {
      shown.textContent = error.message;
    }
  }

  mayReplace(may) {
    this.replaces = may;
    byId('save-go').textContent = may ? 'Replace file' : 'Save file';
  }

  async download(type = this.type, answer = byId('save-answer')) {
    try {
      const isScene = type === 'save_scene';
      const file = isScene
        ? new Blob([(await this.link.ask({type: 'scene_text'})).now], {type: 'application/toml'})
        : await this.picture();
      const name = this.paths[type].split('/').pop().replace(/\.[^.]*$/, '');
      const link = element('a', {href: URL.createObjectURL(file), download: name + (isScene ? '.toml' : '.png')});
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
      answer.textContent = `Downloading ${link.download}`;
    } catch (error) {
      answer.textContent = error.message;
    }
  }

  // The bits of the exact picture: a preview is not given away as one.
  picture() {
    if (document.body.dataset.stage !== 'exact') throw new Error('The exact picture is not drawn yet');
    return new Promise((resolve) => { this.canvas.toBlob(resolve, 'image/png'); });
  }

  async save() {
    const path = byId('save-path').value;
    const answer = byId('save-answer');
    answer.textContent = 'Saving';
    try {
      const {saved, path: place} = await this.link.ask({type: this.type, path, replace: this.replaces});
      answer.textContent = saved ? `Saved ${place}` : `${place} exists already. Replace it?`;
      this.mayReplace(!saved);
      if (saved) this.paths[this.type] = path;
    } catch (error) {
      answer.textContent = error.message;
    }
  }
}
