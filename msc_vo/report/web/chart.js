// A plot over time that zooms and follows the current frame.

function svgElement(name, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes || {})) element.setAttribute(key, value);
  return element;
}

// Multiples of 1, 2 or 5 times a power of ten from `low` to `high`, about `count` of them.
function niceTicks(low, high, count) {
  const raw = (high - low) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((value) => value >= raw * 0.999);
  const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    ticks.push({value: i * step, text: (i * step).toFixed(decimals)});
  }
  return ticks;
}

const CHART_MARGIN = {
  left: 56,
  right: 14,
  top: 26,
  bottom: 38
};
const CHART_STRIP = {
  y: 15,
  height: 7
};
const CHART_HEIGHT = 240;

// `spec`: name and unit of y; curves: {css, label, values (one per frame)}; is_stacked: the curves
// but for the last are areas on top of each other; has_stems: a stem for each positive value;
// has_status: a strip with the status of the frames.
class Chart {
  constructor(model, figure, spec) {
    this.model = model;
    this.spec = spec;
    this.element = document.createElement("div");
    this.element.className = "chart";
    this.element.tabIndex = 0;
    this.element.setAttribute("role", "img");
    this.element.setAttribute(
        "aria-label", `${spec.name} over time. Plus and minus zoom, Escape resets.`);
    this.svg = svgElement("svg");
    this.element.append(this.svg);
    figure.append(this.element);
    this.drag = null;
    for (const [name, listener] of [
             ["pointerdown", "onDown"], ["pointermove", "onMove"], ["pointerup", "onUp"],
             ["pointercancel", "onCancel"], ["wheel", "onWheel"], ["dblclick", "onReset"],
             ["keydown", "onKey"]]) {
      this.element.addEventListener(name, (event) => this[listener](event), {passive: false});
    }
    model.addEventListener("frame", () => this.drawCursor());
    model.addEventListener("span", () => this.draw());
    model.addEventListener("data", () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.element);
    this.draw();
  }

  // Draws everything; `width` units are pixels.
  draw() {
    this.width = this.element.clientWidth;
    if (this.width < 100 || this.model.count === 0) return;
    this.series = this.spec.curves(this.model);
    const [from, to] = this.model.span || [0, this.model.duration()];
    Object.assign(this, {from, to, first: lastNotAbove(this.model.columns.time, from)});
    this.last = Math.min(this.model.count - 1, lastNotAbove(this.model.columns.time, to) + 1);
    this.high = this.highest();
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${CHART_HEIGHT}`);
    this.svg.replaceChildren();
    this.drawGrid();
    this.inside = svgElement("svg", {
      x: CHART_MARGIN.left,
      y: 0,
      height: CHART_HEIGHT,
      width: this.width - CHART_MARGIN.left - CHART_MARGIN.right,
      viewBox: `${CHART_MARGIN.left} 0 ${this.width - CHART_MARGIN.left - CHART_MARGIN.right} ${
          CHART_HEIGHT}`,
      style: `height:${CHART_HEIGHT}px;overflow:hidden`
    });
    this.svg.append(this.inside);
    if (this.spec.has_status) this.drawStatus();
    if (this.spec.has_stems) this.drawStems();
    else this.drawCurves();
    this.selection = svgElement("rect", {
      class: "selection",
      y: CHART_MARGIN.top,
      height: this.bottom() - CHART_MARGIN.top,
      width: 0
    });
    this.cursor = svgElement("path", {class: "cursor", fill: "none"});
    this.valueText =
        svgElement("text", {class: "value", x: this.width - CHART_MARGIN.right - 4, y: 11});
    this.svg.append(this.selection, this.cursor, this.valueText);
    this.drawCursor();
  }

  bottom() {
    return CHART_HEIGHT - CHART_MARGIN.bottom;
  }
  x(seconds) {
    return CHART_MARGIN.left +
        (seconds - this.from) / (this.to - this.from) *
        (this.width - CHART_MARGIN.left - CHART_MARGIN.right);
  }
  y(value) {
    return this.bottom() - value / this.high * (this.bottom() - CHART_MARGIN.top);
  }
  secondsAt(event) {
    const inner = event.clientX - this.svg.getBoundingClientRect().left - CHART_MARGIN.left;
    return this.from +
        clamp(inner / (this.width - CHART_MARGIN.left - CHART_MARGIN.right), 0, 1) *
        (this.to - this.from);
  }

  highest() {
    let high = 0;
    for (const {values} of this.series) {
      for (let i = this.first; i <= this.last; ++i)
        if (values[i] > high) high = values[i];
    }
    return high > 0 && Number.isFinite(high) ? 1.06 * high : 1;
  }

  text(attributes, content) {
    const element = svgElement("text", attributes);
    element.textContent = content;
    this.svg.append(element);
  }

  drawGrid() {
    for (const {value, text} of niceTicks(this.from, this.to, this.width / 90)) {
      const x = this.x(value);
      this.svg.append(
          svgElement("path", {class: "grid", d: `M${x} ${CHART_MARGIN.top}V${this.bottom()}`}));
      this.text({class: "tick-x", x, y: this.bottom() + 15}, text);
    }
    for (const {value, text} of niceTicks(0, this.high, 6)) {
      const y = this.y(value);
      this.svg.append(svgElement(
          "path",
          {class: "grid", d: `M${CHART_MARGIN.left} ${y}H${this.width - CHART_MARGIN.right}`}));
      this.text({class: "tick-y", x: CHART_MARGIN.left - 6, y: y + 4}, text);
    }
    this.text({class: "tick-x name", x: this.width / 2, y: CHART_HEIGHT - 6}, "time, s");
    this.text(
        {
          class: "tick-x name",
          transform: `translate(13,${(CHART_MARGIN.top + this.bottom()) / 2}) rotate(-90)`
        },
        `${this.spec.name}, ${this.spec.unit}`.replace(/, $/, ""));
  }

  // Frames of the same status are one rectangle; of those in one pixel the worst status counts.
  drawStatus() {
    const {status, time} = this.model.columns;
    for (let i = this.first; i <= this.last;) {
      const x = this.x(time[i]);
      let end = i + 1, worst = status[i];
      while (end <= this.last && (status[end] === worst || this.x(time[end]) - x < 1)) {
        worst = Math.max(worst, status[end++]);
      }
      const right = end < this.model.count ? this.x(time[end]) : this.x(this.to);
      this.inside.append(svgElement("rect", {
        class: `status-${STATUS_NAMES[worst]}`,
        x,
        y: CHART_STRIP.y,
        width: Math.max(1, right - x),
        height: CHART_STRIP.height
      }));
      i = end;
    }
  }

  // Points of a curve; of each pixel column the lowest and the highest value are kept.
  points(values) {
    const times = this.model.columns.time;
    const kept = [];
    let column = null, low = 0, high = 0;
    const flush = () => {
      if (column === null) return;
      for (const i of low === high ? [low] : [Math.min(low, high), Math.max(low, high)]) {
        kept.push(`${this.x(times[i]).toFixed(1)},${this.y(values[i]).toFixed(1)}`);
      }
    };
    for (let i = this.first; i <= this.last; ++i) {
      if (!Number.isFinite(values[i])) continue;
      const at = Math.floor(this.x(times[i]));
      if (at !== column) {
        flush();
        [column, low, high] = [at, i, i];
      }
      if (values[i] < values[low]) low = i;
      if (values[i] > values[high]) high = i;
    }
    flush();
    return kept;
  }

  drawCurves() {
    const order = this.spec.is_stacked ?
        [...this.series.slice(0, -1)].reverse().concat(this.series.slice(-1)) :
        this.series;
    order.forEach((series, i) => {
      const points = this.points(series.values);
      if (points.length === 0) return;
      if (this.spec.is_stacked && i < order.length - 1) {
        const ends = [points[0], points[points.length - 1]].map((point) => point.split(",")[0]);
        points.push(`${ends[1]},${this.bottom()}`, `${ends[0]},${this.bottom()}`);
        this.inside.append(svgElement("polygon", {class: series.css, points: points.join(" ")}));
      } else {
        this.inside.append(
            svgElement("polyline", {class: `curve ${series.css}`, points: points.join(" ")}));
      }
    });
  }

  drawStems() {
    const {values, css} = this.series[0];
    for (let i = this.first; i <= this.last; ++i) {
      if (!(values[i] > 0)) continue;
      const x = this.x(this.model.columns.time[i]), y = this.y(values[i]);
      this.inside.append(
          svgElement("path", {class: "stem", d: `M${x} ${this.bottom()}V${y}`}),
          svgElement("circle", {class: css, cx: x, cy: y, r: 2.2}));
    }
  }

  drawCursor() {
    if (!this.cursor || this.model.count === 0) return;
    const frame = this.model.current;
    const seconds = this.model.columns.time[frame];
    const isInside = seconds >= this.from && seconds <= this.to;
    this.cursor.setAttribute(
        "d", isInside ? `M${this.x(seconds)} ${CHART_MARGIN.top}V${this.bottom()}` : "");
    const shown = this.spec.is_stacked ? this.series.slice(-1) : this.series;
    this.valueText.textContent =
        shown
            .map(
                ({label, values}) =>
                    `${label} ${formatNumber(values[frame], this.spec.decimals)} ${this.spec.unit}`
                        .trim())
            .join("   ");
  }

  onDown(event) {
    if (event.button !== 0) return;
    this.element.setPointerCapture(event.pointerId);
    this.drag = {seconds: this.secondsAt(event), x: event.clientX};
  }

  onMove(event) {
    if (!this.cursor) return;
    const seconds = this.secondsAt(event);
    if (this.drag && Math.abs(event.clientX - this.drag.x) > 4) {
      const [a, b] = [this.x(this.drag.seconds), this.x(seconds)];
      this.selection.setAttribute("x", Math.min(a, b));
      this.selection.setAttribute("width", Math.abs(a - b));
    } else {
      this.model.setTime(seconds);
    }
  }

  onUp(event) {
    const drag = this.drag;
    this.onCancel();
    if (!drag || Math.abs(event.clientX - drag.x) <= 4) return;
    const ends = [drag.seconds, this.secondsAt(event)].sort((a, b) => a - b);
    this.model.setSpan(ends);
  }

  onCancel() {
    this.drag = null;
    if (this.selection) this.selection.setAttribute("width", 0);
  }

  onReset() {
    this.model.setSpan(null);
  }

  zoomAround(seconds, factor) {
    this.model.setSpan(
        [seconds - factor * (seconds - this.from), seconds + factor * (this.to - seconds)]);
  }

  // The wheel scrolls the page until the plot was clicked.
  onWheel(event) {
    if (document.activeElement !== this.element && !event.ctrlKey) return;
    event.preventDefault();
    this.zoomAround(this.secondsAt(event), Math.exp(0.002 * clamp(event.deltaY, -200, 200)));
  }

  onKey(event) {
    const seconds = this.model.columns.time[this.model.current];
    if (event.key === "+" || event.key === "=") this.zoomAround(seconds, 0.7);
    else if (event.key === "-") this.zoomAround(seconds, 1 / 0.7);
    else if (event.key === "Escape") this.onReset();
    else return;
    event.preventDefault();
  }
}
