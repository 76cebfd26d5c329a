// What a browser keeps for the page. In another page's frame it may keep nothing.
class Memory {
  constructor(name) { this.name = name; }

  getItem(key) {
    try {
      return window[this.name].getItem(key);
    } catch {
      return null;
    }
  }

  setItem(key, value) {
    try {
      window[this.name].setItem(key, value);
    } catch (error) {
      if (error.name !== 'SecurityError') throw error;
    }
  }
}

export const ofBrowser = new Memory('localStorage');
export const ofTab = new Memory('sessionStorage');

// The state of a page as the end of its address: a link that opens the same, as long as the program
// runs.
const start = '#state=';

const toText = (bytes) => btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
const toBytes = (text) => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));

export function linkTo(state) {
  return start + toText(new TextEncoder().encode(JSON.stringify(state)));
}

// Null: the address has none, or one that was cut off.
export function stateInAddress() {
  if (!location.hash.startsWith(start)) return null;
  try {
    return JSON.parse(new TextDecoder().decode(toBytes(location.hash.slice(start.length))));
  } catch {
    return null;
  }
}
