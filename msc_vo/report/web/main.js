// Builds the interactive page from its data block.

function byId(id) {
  return document.getElementById(id);
}

// A button that is pressed or not.
function toggleButton(label, title, onClick) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = label;
  button.title = title;
  button.addEventListener("click", onClick);
  return button;
}

// Lists the colors of the paths in the 3-D view.
function showLegend(model, list) {
  const entries = sceneLegend(model);
  list.hidden = entries.length === 0;
  list.replaceChildren(...entries.map(([color, text]) => {
    const item = document.createElement("li");
    const swatch = svgElement("svg", {viewBox: "0 0 18 10", "aria-hidden": "true"});
    swatch.append(svgElement("path", {d: "M0 5H18", style: `stroke: var(--${color})`}));
    item.append(swatch, text);
    return item;
  }));
}

// Buttons for views and layers; returns what their keys do.
function startSceneBar(model, scene) {
  const actions = {}, views = {}, layers = {};
  const showPressed = () => {
    for (const [name, button] of Object.entries(views)) {
      button.setAttribute("aria-pressed", name === scene.view);
    }
    for (const [label, button] of Object.entries(layers)) {
      button.setAttribute("aria-pressed", !scene.layers.hidden.has(label));
      button.hidden = scene.layers.isEmpty(label);
    }
  };
  for (const [name, {key}] of Object.entries(SCENE_VIEWS)) {
    actions[key] = () => {
      scene.setView(name);
      showPressed();
    };
    views[name] = toggleButton(name, `${name} view (${key.toUpperCase()})`, actions[key]);
    byId("scene-views").append(views[name]);
  }
  scene.layers.all.forEach(([label], i) => {
    const toggle = () => {
      scene.toggleLayer(label);
      showPressed();
    };
    if (i < 9) actions[i + 1] = toggle;
    layers[label] =
        toggleButton(label, `Show or hide ${label}${i < 9 ? ` (${i + 1})` : ""}`, toggle);
    layers[label].dataset.layer = label;
    byId("scene-layers").append(layers[label]);
  });
  const showAll = () => {
    showPressed();
    showLegend(model, byId("scene-legend"));
  };
  model.addEventListener("data", showAll);
  showAll();
  return actions;
}

// The 3-D view, or null without WebGL.
function startScene(model) {
  try {
    return new SceneView(model, byId("scene-canvas"), byId("scene-image"), byId("scene-label"));
  } catch (error) {
    document.querySelector(".scene-panel").hidden = true;
    document.querySelector(".viewer-grid").style.gridTemplateColumns = "minmax(0, 1fr)";
    return null;
  }
}

function startKeys(model, timeline, sceneActions) {
  const actions = Object.assign(
      {
        " ": () => timeline.togglePlay(),
        "ArrowLeft": (event) => model.setFrame(model.current - (event.shiftKey ? 10 : 1)),
        "ArrowRight": (event) => model.setFrame(model.current + (event.shiftKey ? 10 : 1)),
        "Home": () => model.setFrame(0),
        "End": () => model.setFrame(model.count - 1),
      },
      sceneActions);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const tag = event.target.tagName;
    if (tag === "SELECT" || tag === "TEXTAREA") return;
    if (event.key === " " &&
        (tag === "BUTTON" || tag === "SUMMARY" || event.target.type === "checkbox"))
      return;
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}

function startPage() {
  const surface = byId("surface-data");
  const model = new RunModel(
      JSON.parse(byId("run-data").textContent), surface && JSON.parse(surface.textContent));
  if (model.count === 0 && !model.info.live) return;
  byId("viewer").hidden = false;
  const scene = startScene(model);
  new FramePanel(model, {
    canvas: byId("frame-canvas"),
    missing: byId("frame-missing"),
    place: byId("place"),
    facts: byId("frame-facts"),
    stages: byId("frame-stages")
  });
  const timeline = new Timeline(model, {
    slider: byId("time-slider"),
    strip: byId("status-strip"),
    label: byId("time-label"),
    play: byId("play")
  });
  startCharts(model);
  document.querySelectorAll("figure[data-zoom] > svg").forEach(makeZoomable);
  startKeys(model, timeline, scene ? startSceneBar(model, scene) : {});
  if (model.info.live) {
    new LiveClient(model, {
      bar: byId("live-bar"),
      state: byId("live-state"),
      controls: byId("live-controls"),
      pause: byId("live-pause"),
      step: byId("live-step"),
      speed: byId("live-speed"),
      follow: byId("live-follow")
    });
  }
}

startPage();
