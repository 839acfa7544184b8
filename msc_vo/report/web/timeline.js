// The slider over all frames, the strip of their statuses above it, and the player.

class Timeline {
  constructor(model, elements) {
    this.model = model;
    Object.assign(this, elements);  // slider, strip, label, play
    this.timer = null;
    this.slider.addEventListener("input", () => model.setFrame(Number(this.slider.value)));
    this.play.addEventListener("click", () => this.togglePlay());
    model.addEventListener("frame", () => this.update());
    model.addEventListener("data", () => {
      this.drawStrip();
      this.update();
    });
    onThemeChange(() => this.drawStrip());
    new ResizeObserver(() => this.drawStrip()).observe(this.strip);
    this.drawStrip();
    this.update();
  }

  update() {
    const {model, slider} = this;
    slider.max = Math.max(0, model.count - 1);
    slider.value = model.current;
    const seconds = model.count > 0 ? model.columns.time[model.current] : 0;
    this.label.textContent =
        `frame ${model.current} / ${Math.max(0, model.count - 1)}, ${seconds.toFixed(2)} s`;
    slider.setAttribute(
        "aria-valuetext",
        `frame ${model.current}, ${seconds.toFixed(2)} seconds, ${model.status(model.current)}`);
  }

  drawStrip() {
    const {strip, model} = this;
    const width = Math.max(1, Math.round(strip.clientWidth * (devicePixelRatio || 1)));
    strip.width = width;
    strip.height = 8;
    const context = strip.getContext("2d");
    const colors = STATUS_NAMES.map(themeColor);
    // The worst status of the frames of each pixel.
    for (let x = 0; x < width && model.count > 0; ++x) {
      const first = Math.floor(x / width * model.count);
      const end = Math.max(first + 1, Math.floor((x + 1) / width * model.count));
      let worst = 0;
      for (let i = first; i < end; ++i) worst = Math.max(worst, model.columns.status[i]);
      context.fillStyle = colors[worst];
      context.fillRect(x, 0, 1, 8);
    }
  }

  togglePlay() {
    if (this.timer !== null) {
      this.stop();
      return;
    }
    const {model} = this;
    if (model.current >= model.count - 1) model.setFrame(0);
    this.play.textContent = "❚❚";
    this.play.setAttribute("aria-label", "Pause");
    const start = performance.now() - 1000 * model.columns.time[model.current];
    this.timer = setInterval(() => {
      model.setTime((performance.now() - start) / 1000);
      if (model.current >= model.count - 1) this.stop();
    }, 33);
  }

  stop() {
    clearInterval(this.timer);
    this.timer = null;
    this.play.textContent = "▶";
    this.play.setAttribute("aria-label", "Play");
  }
}
