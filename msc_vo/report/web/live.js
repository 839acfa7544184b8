// The live page: asks the running command for new frames, and controls its pace.

const POLL_INTERVAL_MS = 150;
const MAX_KEPT_VIEWS = 600;

class LiveClient {
  constructor(model, elements) {
    this.model = model;
    Object.assign(this, elements);  // bar, state, controls, pause, step, speed, follow
    this.mapVersion = -1;
    this.isPaused = false;
    this.failures = 0;
    this.bar.hidden = false;
    this.pause.addEventListener("click", () => this.send(this.isPaused ? "resume" : "pause"));
    this.step.addEventListener("click", () => this.send("step"));
    this.speed.addEventListener("change", () => this.send("speed", this.speed.value));
    this.poll();
  }

  // The header keeps pages of other origins from controlling the run.
  send(action, value = "") {
    return fetch(
               `control?action=${action}&value=${encodeURIComponent(value)}`,
               {method: "POST", headers: {"X-Msc-Vo": "control"}})
        .catch(() => {});
  }

  async poll() {
    let delay = POLL_INTERVAL_MS;
    try {
      const lastView =
          this.model.views.length ? this.model.views[this.model.views.length - 1].frame : -1;
      const response = await fetch(
          `data?frames=${this.model.count}&map=${this.mapVersion}&view=${lastView}`,
          {cache: "no-store"});
      if (!response.ok) throw new Error(`status ${response.status}`);
      const update = await response.json();
      if (update.run !== this.model.info.run) {
        location.reload();  // another run now uses the port
        return;
      }
      this.failures = 0;
      this.show(update);
      if (update.state === "finished") {
        await this.showReport();
        return;
      }
      if (update.more) delay = 0;
    } catch (error) {
      if (++this.failures > 10) {
        this.end("The run has ended or cannot be reached; its results are in report.html.");
        return;
      }
    }
    setTimeout(() => this.poll(), delay);
  }

  show(update) {
    const {model} = this;
    this.isPaused = update.state === "paused";
    this.pause.setAttribute("aria-pressed", this.isPaused);
    this.pause.textContent = this.isPaused ? "Resume" : "Pause";
    this.step.disabled = !this.isPaused;
    this.controls.hidden = !update.can_pause;
    if (document.activeElement !== this.speed) this.speed.value = String(update.speed);
    this.state.textContent = `${update.state}, ${update.count} of ${update.total} frames`;
    model.moveFrames(update.moved);
    model.addFrames(update.frames);
    model.addViews(update.views);
    if (model.views.length > MAX_KEPT_VIEWS)
      model.views.splice(0, model.views.length - MAX_KEPT_VIEWS);
    model.setMap(update.map);
    if (update.map) model.setPlaces(update);
    this.mapVersion = update.map_version;
    if (this.follow.checked) model.setFrame(this.newestShown());
    if (update.frames || update.map || update.views) model.notifyData();
  }

  // The newest frame, or the newest with a picture if that is hardly older.
  newestShown() {
    const {count, views} = this.model;
    const view = views.length > 0 ? views[views.length - 1].frame : 0;
    return count - 1 - view <= 15 ? view : count - 1;
  }

  // The finished report takes the place of the live page.
  async showReport() {
    this.end("finished");
    try {
      const response = await fetch("report", {cache: "no-store"});
      if (!response.ok) return;
      const page = await response.text();
      document.open();
      document.write(page);
      document.close();
    } catch (error) {
      this.end("The run has finished; its results are in report.html.");
    }
  }

  end(text) {
    this.state.textContent = text;
    this.controls.hidden = true;
  }
}
