// States that are kept as they are, each with its picture; and another one beside the state, to
// compare the two.
import {element} from './elements.js';
import {ofTab} from './memory.js';

const thumbnail = {width: 112, height: 70};
const mostKept = 24;
const full = 'No more views can be kept, expected at most 24 that the browser has room for: remove one first';

export class KeptViews {
  // `refuse` tells why a view is not kept.
  constructor(place, store, picture, memory, refuse) {
    this.refuse = refuse;
    this.store = store;
    this.picture = picture;
    this.memory = memory;
    this.kept = JSON.parse(ofTab.getItem(memory)) ?? [];
    this.other = null;
    this.isB = false;
    this.list = element('ul', {'aria-label': 'Kept views'});
    place.replaceChildren(this.list);
    this.place = place;
    this.show();
  }

  keep() {
    const view = {state: this.store.copy(), known: this.store.known, picture: this.makeThumbnail()};
    this.save([...this.kept, view]);
  }

  makeThumbnail() {
    const {canvas} = this.picture;
    const small = element('canvas', thumbnail);
    const scale = Math.max(thumbnail.width / canvas.width, thumbnail.height / canvas.height);
    const width = canvas.width * scale, height = canvas.height * scale;
    small.getContext('2d').drawImage(canvas, (thumbnail.width - width) / 2, (thumbnail.height - height) / 2, width, height);
    return small.toDataURL('image/jpeg', 0.8);
  }

  open({state, known}) {
    Object.assign(this.store.known, known);
    this.store.take(state);
  }

  remove(view) {
    this.save(this.kept.filter((other) => other !== view));
  }

  save(kept) {
    if (kept.length > mostKept) return this.refuse(full);
    try {
      ofTab.setItem(this.memory, JSON.stringify(kept));
    } catch {
      return this.refuse(full);
    }
    this.kept = kept;
    this.show();
  }

  // The other state takes the place of this one; the first time it is a copy to change.
  swap() {
    const here = this.store.copy();
    if (this.other !== null) this.store.take(this.other);
    this.other = here;
    this.isB = !this.isB;
  }

  show() {
    this.place.hidden = this.kept.length === 0;
    this.list.replaceChildren(...this.kept.map((view, i) => {
      const picture = element('img', {src: view.picture, alt: '', ...thumbnail});
      const open = element('button', {type: 'button', className: 'kept', onclick: () => this.open(view),
                                      'aria-label': `Open kept view ${i + 1}`}, picture);
      const remove = element('button', {type: 'button', className: 'remove', onclick: () => this.remove(view),
                                        'aria-label': `Remove kept view ${i + 1}`}, '×');
      return element('li', {}, open, remove);
    }));
  }
}
