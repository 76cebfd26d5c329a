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
