// The connection to the program: states up, frames down, questions with their answers. Connects
// again when the connection is lost.
const retryMilliseconds = 1000;

export class Link extends EventTarget {
  constructor() {
    super();
    this.questions = new Map();
    this.lastQuestion = 0;
    this.lastState = 0;
    this.pendingState = null;
    this.connect();
  }

  connect() {
    const address = new URL('live', document.baseURI);
    address.protocol = location.protocol === 'https:' ? 'wss:' : 'ws:';
    this.socket = new WebSocket(address);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onmessage = (event) => this.take(event.data);
    this.socket.onclose = () => this.lost();
  }

  get isOpen() { return this.socket.readyState === WebSocket.OPEN; }

  // The newest of each animation frame is sent.
  sendState(state) {
    const isFirst = this.pendingState === null;
    this.pendingState = state;
    if (isFirst) requestAnimationFrame(() => this.flush());
  }

  flush() {
    const state = this.pendingState;
    this.pendingState = null;
    if (state === null || !this.isOpen) return;
    this.lastState += 1;
    this.send({type: 'state', number: this.lastState, ...state});
  }

  // Resolves to the answer; rejects with the program's error.
  ask(question) {
    if (!this.isOpen) return Promise.reject(new Error('the program is not connected'));
    this.flush();  // the answer is about what the page shows
    const id = ++this.lastQuestion;
    return new Promise((resolve, reject) => {
      this.questions.set(id, {resolve, reject});
      this.send({...question, id});
    });
  }

  acknowledge(frame) {
    if (this.isOpen) this.send({type: 'acknowledge', frame});
  }

  send(message) { this.socket.send(JSON.stringify(message)); }

  take(data) {
    if (data instanceof ArrayBuffer) {
      const bytes = new DataView(data).getUint32(0, true);
      const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, bytes)));
      const file = new Blob([new Uint8Array(data, 4 + bytes)], {type: header.format});
      this.tell('frame', {header, file});
      return;
    }
    const message = JSON.parse(data);
    if (message.type === 'answer') {
      this.resolve(message);
    } else {
      this.tell(message.type, message);
    }
  }

  resolve(answer) {
    const question = this.questions.get(answer.id);
    this.questions.delete(answer.id);
    if (!question) return;
    if (answer.error !== undefined) {
      question.reject(new Error(answer.error));
    } else {
      question.resolve(answer);
    }
  }

  lost() {
    for (const {reject} of this.questions.values()) reject(new Error('the connection was lost'));
    this.questions.clear();
    this.tell('lost', null);
    setTimeout(() => this.connect(), retryMilliseconds);
  }

  tell(type, detail) { this.dispatchEvent(new CustomEvent(type, {detail})); }
}
