// The image of the current frame with its tracked features, and its numbers.

const LINE_COLORS = ["axis-0", "axis-1", "axis-2", "axis-none", "no-depth"];
const PIXEL_SCALE = 8;  // positions of features are stored in eighths of a pixel

// Draws points and lines of a view onto `context`, whose unit is a pixel of the camera and whose
// origin is the corner of the image, half a pixel beside the centre of its first pixel; `unit`:
// pixels of the camera per pixel of the page.
function drawFeatures(context, view, unit) {
  context.translate(0.5, 0.5);
  const radius = 1.7 * unit;
  for (let i = 0; i < view.pointDepth.length; ++i) {
    context.fillStyle = themeColor(view.pointDepth[i] ? "tracked-point" : "no-depth");
    const x = view.points[2 * i] / PIXEL_SCALE, y = view.points[2 * i + 1] / PIXEL_SCALE;
    context.fillRect(x - radius / 2, y - radius / 2, radius, radius);
  }
  context.lineCap = "round";
  for (const [width, halo] of [[3.4, true], [1.9, false]]) {
    context.lineWidth = width * unit;
    view.lineColors.forEach((color, i) => {
      context.strokeStyle = halo ? "rgba(0, 0, 0, 0.45)" : themeColor(LINE_COLORS[color]);
      context.beginPath();
      context.moveTo(view.lines[4 * i] / PIXEL_SCALE, view.lines[4 * i + 1] / PIXEL_SCALE);
      context.lineTo(view.lines[4 * i + 2] / PIXEL_SCALE, view.lines[4 * i + 3] / PIXEL_SCALE);
      context.stroke();
    });
  }
}

class FramePanel {
  constructor(model, elements) {
    this.model = model;
    this.canvas = elements.canvas;
    this.missing = elements.missing;
    this.place = elements.place;
    this.facts = elements.facts;
    this.stages = elements.stages;
    this.picture = new Image();
    this.picture.addEventListener("load", () => this.drawPicture());
    this.canvas.style.aspectRatio = `${model.info.camera.width} / ${model.info.camera.height}`;
    model.addEventListener("frame", () => this.update());
    model.addEventListener("data", () => this.update());
    onThemeChange(() => this.drawPicture());
    new ResizeObserver(() => this.drawPicture()).observe(this.canvas);
    this.update();
  }

  update() {
    if (this.model.count === 0) return;
    this.updatePicture();
    this.updatePlace();
    this.updateFacts();
    this.updateStages();
  }

  updatePicture() {
    const view = this.model.viewOf(this.model.current);
    this.view = view;
    this.canvas.hidden = this.model.views.length === 0;
    this.missing.hidden = !view || view.frame === this.model.current;
    if (!view) return;
    this.missing.textContent = `image of frame ${view.frame}`;
    if (this.picture.src === view.url) this.drawPicture();
    else this.picture.src = view.url;
  }

  // The place where the run was found, as the run and the map show it.
  updatePlace() {
    const place = this.model.place;
    this.place.hidden = !place;
    if (!place) return;
    const sides = [
      [place.jpeg, `frame ${place.frame} of the run`],
      [place.keyframe_jpeg, `keyframe ${place.keyframe} of the map`],
    ];
    this.place.querySelectorAll("figure").forEach((figure, i) => {
      const url = jpegUrl(sides[i][0]), image = figure.querySelector("img");
      if (image.src !== url) image.src = url;
      figure.querySelector("figcaption").textContent = sides[i][1];
    });
  }

  drawPicture() {
    const {canvas, view, picture} = this;
    const width = canvas.clientWidth;
    if (!view || !width || !picture.complete || !picture.naturalWidth) return;
    const camera = this.model.info.camera;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(width * ratio * camera.height / camera.width);
    const context = canvas.getContext("2d");
    context.drawImage(picture, 0, 0, canvas.width, canvas.height);
    context.fillStyle = "rgba(0, 0, 0, 0.18)";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.scale(canvas.width / camera.width, canvas.height / camera.height);
    drawFeatures(context, view, camera.width / width);
  }

  updateFacts() {
    const {model} = this;
    const frame = model.current;
    const value = (name, component) => model.value(name, frame, component);
    const sigma = (index) => `${formatNumber(value("sigma", index), 3)} deg, ` +
        `${formatNumber(1000 * value("sigma", index + 1), 1)} mm`;
    const rows = [
      ["Frame", `${frame}${value("keyframe") ? ", keyframe" : ""}`],
      ["Status", model.status(frame)],
      ["Inlier points", `${value("counts", 2)} of ${value("counts", 0)}`],
      ["Inlier lines", `${value("counts", 3)} of ${value("counts", 1)}`],
      ["Sigma of rotation", `${formatNumber(value("sigma", 0), 3)} deg`],
      ["Sigma of translation", `${formatNumber(1000 * value("sigma", 1), 2)} mm`],
      ["Sigma in the world", sigma(2)],
      ["Sigma of odometry", sigma(4)],
    ];
    // All frames of a run have the same rows, so that the page does not move.
    if (model.groundTruth.length > 0) {
      rows.push(["Position error", `${formatNumber(1000 * value("error"), 1)} mm`]);
    }
    rows.push(["Tracking", `${formatNumber(value("tracking_ms"), 1)} ms`]);
    if (!model.info.live) {
      const mapping = value("mapping_ms");
      rows.push(["Mapping", mapping > 0 ? `${formatNumber(mapping, 1)} ms` : "–"]);
    }
    this.facts.replaceChildren(...rows.flatMap(([name, text]) => {
      const term = document.createElement("dt"), detail = document.createElement("dd");
      term.textContent = name;
      detail.textContent = text;
      if (name === "Status") {
        const dot = document.createElement("span");
        dot.className = "status-dot";
        dot.style.background = themeColor(text);
        detail.prepend(dot);
      }
      return [term, detail];
    }));
  }

  // The stages that follow each other, as one bar and a list.
  updateStages() {
    const {model} = this;
    const stages = [];
    model.info.stages.forEach((stage, i) => {
      if (!stage.stacked) return;
      stages.push({
        name: stage.name,
        ms: model.value("stage_ms", model.current, i),
        css: `stage-${stages.length % 6}`
      });
    });
    const total = Math.max(
        model.value("tracking_ms", model.current), stages.reduce((sum, stage) => sum + stage.ms, 0),
        1e-6);
    const bar = svgElement(
        "svg", {viewBox: "0 0 1000 10", preserveAspectRatio: "none", "aria-hidden": "true"});
    let at = 0;
    for (const stage of stages) {
      const width = 1000 * stage.ms / total;
      bar.append(svgElement("rect", {class: stage.css, x: at, y: 0, width, height: 10}));
      at += width;
    }
    const list = document.createElement("ul");
    for (const stage of stages) {
      const item = document.createElement("li");
      const swatch = svgElement("svg", {viewBox: "0 0 9 9", "aria-hidden": "true"});
      swatch.append(svgElement("rect", {class: stage.css, width: 9, height: 9}));
      const number = document.createElement("span");
      number.textContent = `${formatNumber(stage.ms, 1)} ms`;
      item.append(swatch, stage.name, number);
      list.append(item);
    }
    this.stages.replaceChildren(bar, list);
  }
}
