// What the plots of the page show, by the data-chart of their figures.

function column(model, name, component, factor = 1) {
  const width = model.widthOf(FRAME_COLUMNS.find((candidate) => candidate[0] === name));
  const values = new Float32Array(model.count);
  for (let i = 0; i < model.count; ++i)
    values[i] = factor * model.columns[name][i * width + component];
  return values;
}

// Sums of the stages up to each that is stacked, and the whole time of tracking.
function stackedStages(model) {
  const curves = [];
  let sum = new Float32Array(model.count);
  model.info.stages.forEach((stage, i) => {
    if (!stage.stacked) return;
    const values = column(model, "stage_ms", i);
    sum = sum.map((value, frame) => value + values[frame]);
    curves.push({css: `stage-${curves.length % 6}`, label: stage.name, values: sum});
  });
  curves.push({css: "whole", label: "tracking", values: column(model, "tracking_ms", 0)});
  return curves;
}

const CHARTS = {
  error: {
    name: "position error",
    unit: "mm",
    decimals: 1,
    has_status: true,
    curves: (model) => [{css: "error", label: "", values: column(model, "error", 0, 1000)}],
  },
  inliers: {
    name: "inliers",
    unit: "",
    decimals: 0,
    has_status: true,
    curves: (model) =>
        [{css: "points", label: "points", values: column(model, "counts", 2)},
         {css: "lines", label: "lines", values: column(model, "counts", 3)}],
  },
  sigma: {
    name: "standard deviation",
    unit: "mm",
    decimals: 2,
    curves: (model) =>
        [{css: "estimate", label: "translation", values: column(model, "sigma", 1, 1000)}],
  },
  stages: {
    name: "tracking",
    unit: "ms",
    decimals: 1,
    is_stacked: true,
    curves: stackedStages,
  },
  mapping: {
    name: "mapping",
    unit: "ms",
    decimals: 1,
    has_stems: true,
    curves: (model) => [{css: "fill-mapping", label: "", values: column(model, "mapping_ms", 0)}],
  },
};

function startCharts(model) {
  for (const figure of document.querySelectorAll("figure[data-chart]")) {
    const spec = CHARTS[figure.dataset.chart];
    if (spec) new Chart(model, figure, spec);
  }
}

// Zooms and moves a static drawing by its viewBox: wheel with Ctrl or after a click, drag,
// double-click.
function makeZoomable(svg) {
  const home = svg.getAttribute("viewBox").split(" ").map(Number);
  let box = [...home], drag = null;
  const show = () => svg.setAttribute("viewBox", box.join(" "));
  const toDrawing = (event) => {
    const bounds = svg.getBoundingClientRect();
    return [
      box[0] + (event.clientX - bounds.left) / bounds.width * box[2],
      box[1] + (event.clientY - bounds.top) / bounds.height * box[3]
    ];
  };
  const zoom = ([x, y], factor) => {
    factor = clamp(factor, home[2] / 40 / box[2], home[2] / box[2]);
    box = [x - factor * (x - box[0]), y - factor * (y - box[1]), factor * box[2], factor * box[3]];
    if (box[2] >= 0.999 * home[2]) box = [...home];
    show();
  };
  svg.classList.add("zoomable");
  svg.setAttribute("tabindex", "0");
  svg.addEventListener("wheel", (event) => {
    if (document.activeElement !== svg && !event.ctrlKey) return;
    event.preventDefault();
    zoom(toDrawing(event), Math.exp(0.002 * clamp(event.deltaY, -200, 200)));
  }, {passive: false});
  svg.addEventListener("pointerdown", (event) => {
    svg.setPointerCapture(event.pointerId);
    drag = toDrawing(event);
  });
  svg.addEventListener("pointermove", (event) => {
    if (!drag) return;
    const at = toDrawing(event);
    box = [box[0] + drag[0] - at[0], box[1] + drag[1] - at[1], box[2], box[3]];
    show();
  });
  for (const name of ["pointerup", "pointercancel"])
    svg.addEventListener(name, () => {
      drag = null;
    });
  svg.addEventListener("dblclick", () => {
    box = [...home];
    show();
  });
  svg.addEventListener("keydown", (event) => {
    const center = [box[0] + box[2] / 2, box[1] + box[3] / 2];
    if (event.key === "+" || event.key === "=") zoom(center, 0.8);
    else if (event.key === "-") zoom(center, 1.25);
    else if (event.key === "Escape") {
      box = [...home];
      show();
    }
  });
}
