// The contents of the 3-D view: one object per layer, filled from the model.

const AXIS_COLORS = ["axis-0", "axis-1", "axis-2", "axis-none"];
const SUBMAP_COLORS = ["estimate", "submap-1", "submap-2", "submap-3", "submap-4", "submap-5"];
const SESSION_COLORS = ["session-0", "session-1", "session-2"];

// The eight segments of a camera frustum of the given depth (metres), in camera coordinates.
function frustumSegments(camera, depth) {
  const corner =
      (u, v) => [(u - camera.cx) / camera.fx * depth, (v - camera.cy) / camera.fy * depth, depth];
  const right = camera.width - 0.5, bottom = camera.height - 0.5;  // centres of pixels are integers
  const corners = [
    corner(-0.5, -0.5), corner(right, -0.5), corner(right, bottom), corner(-0.5, bottom)
  ];
  const ends = [];
  corners.forEach((point, i) => ends.push(0, 0, 0, ...point, ...point, ...corners[(i + 1) % 4]));
  return new Float32Array(ends);
}

// Position and quaternion as a matrix.
function matrixOf(p) {
  return new THREE.Matrix4().compose(
      new THREE.Vector3(p[0], p[1], p[2]), new THREE.Quaternion(p[3], p[4], p[5], p[6]),
      new THREE.Vector3(1, 1, 1));
}

// The pose of a frame as a matrix from camera to world.
function poseMatrix(model, frame) {
  return matrixOf(model.columns.pose.subarray(7 * frame, 7 * frame + 7));
}

// The position of a frame, three numbers.
function positionOf(model, frame) {
  return model.columns.pose.subarray(7 * frame, 7 * frame + 3);
}

// The positions of all frames that have one.
function trajectoryOf(model) {
  const points = [];
  for (let i = 0; i < model.count; ++i) {
    if (model.hasPose(i)) points.push(...positionOf(model, i));
  }
  return new Float32Array(points);
}

// The names of the colors of submaps, by number. The first one has that of estimates.
function submapColors(model) {
  const names = new Map();
  model.submaps().forEach(
      ({number}, i) => names.set(number, SUBMAP_COLORS[i % SUBMAP_COLORS.length]));
  return names;
}

// One segment per closed loop, between the positions of its two frames.
function loopSegments(model) {
  const ends = [];
  for (const frames of model.loops) {
    if (!frames.every((frame) => model.hasPose(frame))) continue;
    for (const frame of frames) ends.push(...positionOf(model, frame));
  }
  return new Float32Array(ends);
}

// Three strokes through a position, each `length` metres.
function crossSegments(position, length) {
  const ends = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [-0.5, 0.5]) {
      ends.push(...position.map((value, i) => value + (i === axis ? side * length : 0)));
    }
  }
  return new Float32Array(ends);
}

// What the colors of paths mean: [color, text]. Empty if there is only the trajectory.
function sceneLegend(model) {
  const entries = [];
  const submaps = model.submaps(), colors = submapColors(model);
  if (submaps.length > 1) {
    for (const {number, first} of submaps) {
      entries.push([colors.get(number), `submap ${number}, from frame ${first}`]);
    }
  }
  if (model.odometry.length > 0) entries.push(["odometry", "before loops were closed"]);
  if (loopSegments(model).length > 0) entries.push(["ink", "loop: two frames at one place"]);
  model.map.sessions.forEach(({name}, i) => {
    const text = name ? `earlier session: ${name}` : "earlier sessions";
    entries.push([SESSION_COLORS[i % SESSION_COLORS.length], text]);
  });
  if (entries.length > 0 && submaps.length === 1) entries.unshift(["estimate", "trajectory"]);
  return entries;
}

// The fused surface. It is drawn from its front only, so that one looks into rooms from outside, and
// a little behind its place, so that lines on it are seen.
function makeSurface(model) {
  const {surface} = model;
  const geometry = new THREE.BufferGeometry();
  const material = new THREE.MeshBasicMaterial(
      {vertexColors: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 50});
  if (surface) {
    geometry.setAttribute("position", new THREE.BufferAttribute(surface.positions, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(surface.colors, 3, true));
    geometry.setIndex(new THREE.BufferAttribute(surface.triangles, 1));
  }
  const mesh = new THREE.Mesh(geometry, material);
  mesh.matrixAutoUpdate = false;
  const frame = surface ? model.frameAt(surface.time) : -1;
  if (frame >= 0 && Number.isFinite(model.value("pose", frame))) {
    const inverse = new THREE.Matrix4().getInverse(matrixOf(surface.pose));
    mesh.matrix.multiplyMatrices(poseMatrix(model, frame), inverse);
  }
  return mesh;
}

// Translucent plates that do not hide what is behind them. Like the surface, they are seen from
// their front only.
function makePlates() {
  const mesh = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial(
      {vertexColors: true, transparent: true, opacity: 0.25, depthWrite: false}));
  mesh.frustumCulled = false;
  return mesh;
}

class SceneLayers {
  constructor(model, group) {
    this.model = model;
    this.lines = new ThickLines(1.6);
    this.keyframes = new ThickLines(1, 0.5);
    this.trajectory = new ThickLines(2.4);
    this.truth = new ThickLines(4, 0.5);
    this.odometry = new ThickLines(1.2);
    this.loops = new ThickLines(3);
    this.sessions = new ThickLines(1.8, 0.8);
    this.found = new ThickLines(3);
    this.axes = new ThickLines(4);
    this.camera = new ThickLines(2);
    this.points = new THREE.Points(
        new THREE.BufferGeometry(),
        new THREE.PointsMaterial(
            {size: 2, sizeAttenuation: false, transparent: true, opacity: 0.55}));
    this.points.frustumCulled = false;
    this.surface = makeSurface(model);
    this.planes = makePlates();
    this.camera.matrixAutoUpdate = false;
    // Label, object; the first nine in order of the keys 1 to 9.
    this.all = [
      ["lines", this.lines], ["points", this.points], ["keyframes", this.keyframes],
      ["trajectory", this.trajectory], [model.truthName, this.truth], ["axes", this.axes],
      ["camera", this.camera], ["surface", this.surface], ["loops", this.loops],
      ["before loops", this.odometry], ["earlier sessions", this.sessions], ["found", this.found],
      ["planes", this.planes]
    ];
    this.hidden = new Set();
    for (const [, object] of this.all) group.add(object);
  }

  // Whether the layer has anything to show.
  isEmpty(label) {
    if (label === this.model.truthName) return this.model.groundTruth.length === 0;
    if (label === "loops") return loopSegments(this.model).length === 0;
    if (label === "before loops") return this.model.odometry.length === 0;
    if (label === "earlier sessions") return this.model.map.sessions.length === 0;
    if (label === "found") return !this.model.hasPose(this.model.found);
    if (label === "axes") return !this.model.axes;
    if (label === "surface") return !this.model.surface;
    if (label === "planes") return this.model.map.planes.length === 0;
    return false;
  }

  toggle(label) {
    if (this.hidden.has(label)) this.hidden.delete(label);
    else this.hidden.add(label);
  }

  // `from_camera`: frusta close to the eye would hide the rest, and the surface the image.
  show(from_camera) {
    for (const [label, object] of this.all) {
      object.visible = !this.hidden.has(label) && !this.isEmpty(label);
    }
    if (from_camera) {
      for (const object of [this.camera, this.keyframes, this.surface, this.found, this.planes]) {
        object.visible = false;
      }
    }
  }

  // `scale`: size of the scene in metres.
  fill(scale) {
    const model = this.model;
    const colors = AXIS_COLORS.map((name) => new THREE.Color(themeColor(name)));
    const lineColors = new Float32Array(3 * model.map.axes.length);
    model.map.axes.forEach((axis, i) => {
      const color = colors[Math.min(axis, 3)];
      lineColors.set([color.r, color.g, color.b], 3 * i);
    });
    this.lines.setSegments(model.map.lines, lineColors);
    this.points.geometry.dispose();
    this.points.geometry = new THREE.BufferGeometry();
    this.points.geometry.setAttribute("position", new THREE.BufferAttribute(model.map.points, 3));
    this.points.material.color.set(themeColor("faint"));
    this.fillPlanes(colors);
    this.fillTrajectory();
    this.fillPath(this.truth, model.groundTruth, "ground-truth");
    this.fillPath(this.odometry, model.odometry, "odometry");
    const loops = loopSegments(model);
    this.loops.setSegments(loops, uniformColors(loops.length / 6, themeColor("ink")));
    this.fillSessions();
    this.fillFound(0.08 * scale);
    this.fillKeyframes(0.035 * scale);
    this.fillAxes(0.12 * scale, colors);
    const frustum = frustumSegments(model.info.camera, 0.07 * scale);
    this.camera.setSegments(frustum, uniformColors(frustum.length / 6, themeColor("ink")));
  }

  // Each plane in the color of the axis that its normal is parallel to, grey without one.
  fillPlanes(axisColors) {
    const {planes, planeAxes} = this.model.map;
    const rgb = new Float32Array(planes.length);
    const colors = [...axisColors.slice(0, 3), new THREE.Color(themeColor("faint"))];
    planeAxes.forEach((axis, i) => {
      const color = colors[Math.min(axis, 3)];
      for (let k = 0; k < 9; k += 3) rgb.set([color.r, color.g, color.b], 9 * i + k);
    });
    this.planes.geometry.dispose();
    this.planes.geometry = new THREE.BufferGeometry();
    this.planes.geometry.setAttribute("position", new THREE.BufferAttribute(planes, 3));
    this.planes.geometry.setAttribute("color", new THREE.BufferAttribute(rgb, 3));
  }

  fillPath(object, points, color) {
    const ends = pathSegments(points);
    object.setSegments(ends, uniformColors(ends.length / 6, themeColor(color)));
  }

  // Each submap in its color. Frames of different submaps are not connected.
  fillTrajectory() {
    const {model} = this;
    const names = submapColors(model), ends = [], rgb = [];
    let last = -1;
    for (let i = 0; i < model.count; ++i) {
      if (!model.hasPose(i)) continue;
      const submap = model.columns.submap[i];
      if (last >= 0 && model.columns.submap[last] === submap) {
        ends.push(...positionOf(model, last), ...positionOf(model, i));
        rgb.push(...new THREE.Color(themeColor(names.get(submap))).toArray());
      }
      last = i;
    }
    this.trajectory.setSegments(new Float32Array(ends), new Float32Array(rgb));
  }

  fillSessions() {
    const ends = [], rgb = [];
    this.model.map.sessions.forEach(({positions}, i) => {
      const segments = pathSegments(positions);
      const color = themeColor(SESSION_COLORS[i % SESSION_COLORS.length]);
      for (const coordinate of segments) ends.push(coordinate);
      for (const value of uniformColors(segments.length / 6, color)) rgb.push(value);
    });
    this.sessions.setSegments(new Float32Array(ends), new Float32Array(rgb));
  }

  fillFound(length) {
    if (this.isEmpty("found")) return;
    const cross = crossSegments([...positionOf(this.model, this.model.found)], length);
    this.found.setSegments(cross, uniformColors(3, themeColor("found")));
  }

  fillKeyframes(depth) {
    const frustum = frustumSegments(this.model.info.camera, depth);
    const ends = [], rgb = [];
    const names = submapColors(this.model);
    const point = new THREE.Vector3();
    for (let i = 0; i < this.model.count; ++i) {
      if (!this.model.columns.keyframe[i] || !this.model.hasPose(i)) continue;
      const color = themeColor(names.get(this.model.columns.submap[i]));
      rgb.push(...uniformColors(frustum.length / 6, color));
      const pose = poseMatrix(this.model, i);
      for (let k = 0; k < frustum.length; k += 3) {
        point.fromArray(frustum, k).applyMatrix4(pose);
        ends.push(point.x, point.y, point.z);
      }
    }
    this.keyframes.setSegments(new Float32Array(ends), new Float32Array(rgb));
  }

  // The Manhattan axes, at the first camera.
  fillAxes(length, colors) {
    const {axes, columns, count} = this.model;
    if (!axes || count === 0) return;
    const ends = [], rgb = [];
    const origin = columns.pose.subarray(0, 3);
    for (let i = 0; i < 3; ++i) {
      const tip = [0, 1, 2].map((row) => origin[row] + length * axes[3 * row + i]);
      ends.push(...origin, ...tip);
      rgb.push(colors[i].r, colors[i].g, colors[i].b);
    }
    this.axes.setSegments(new Float32Array(ends), new Float32Array(rgb));
  }

  moveCamera(frame) {
    if (frame < this.model.count) this.camera.matrix.copy(poseMatrix(this.model, frame));
    this.camera.matrixWorldNeedsUpdate = true;
  }

  setResolution(width, height) {
    for (const [, object] of this.all) {
      if (object.setResolution) object.setResolution(width, height);
    }
  }
}
