// Shows frames in the order in which they come. The canvas has the frame's own pixels, and style
// scales it, so that the exact picture is shown bit for bit.
export class Picture {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d', {alpha: false});
    this.last = Promise.resolve();
  }

  // Resolves when it is on the canvas.
  show(file) {
    const decoded = createImageBitmap(file, {colorSpaceConversion: 'none'});
    this.last = Promise.all([decoded, this.last]).then(([bitmap]) => this.draw(bitmap));
    return this.last;
  }

  draw(bitmap) {
    if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height) {
      this.canvas.width = bitmap.width;
      this.canvas.height = bitmap.height;
    }
    this.context.drawImage(bitmap, 0, 0);
    bitmap.close();
  }

  // How large the picture is on the screen.
  get shownWidth() {
    const {width, height} = this.canvas.getBoundingClientRect();
    return Math.min(width, height * this.canvas.width / this.canvas.height);
  }

  // Where a pointer is in the picture, 0 to 1 each way; null: beside it.
  placeOf(event) {
    const box = this.canvas.getBoundingClientRect();
    const width = this.shownWidth;
    const height = width * this.canvas.height / this.canvas.width;
    const x = (event.clientX - box.left - (box.width - width) / 2) / width;
    const y = (event.clientY - box.top - (box.height - height) / 2) / height;
    return x >= 0 && x <= 1 && y >= 0 && y <= 1 ? {x, y} : null;
  }
}
