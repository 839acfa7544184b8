// The data of the run and the current frame. The parts of the page listen for changes:
// "data" (frames, map or views were added), "frame" (another current frame), "span" (another span
// of time in the plots).

const STATUS_NAMES = ["tracked", "weak", "dropped", "unreadable", "predicted", "lost"];

const NO_SUBMAP = 65535;  // the frame has no pose

// Columns of frames: name, type, numbers per frame (0: one per stage).
const FRAME_COLUMNS = [
  ["time", Float32Array, 1],  // seconds since the first frame
  ["pose", Float32Array, 7],  // world_from_cam: position in metres, quaternion x y z w
  ["status", Uint8Array, 1],  // index into STATUS_NAMES
  ["keyframe", Uint8Array, 1],
  ["submap", Uint16Array, 1],  // number of the submap that the pose refers to, or NO_SUBMAP
  ["counts", Uint16Array, 4],  // points, lines, inlier points, inlier lines
  // Rotation in degrees, translation in metres: of the pose in the map nearby, in the world, and by
  // odometry; NaN: no estimate.
  ["sigma", Float32Array, 6],
  ["error", Float32Array, 1],  // metres; NaN: no ground truth
  ["stage_ms", Float32Array, 0],
  ["tracking_ms", Float32Array, 1],
  ["mapping_ms", Float32Array, 1],
];

// Positions are stored in steps from the corner of their bounding box.
function decodeSurface(surface) {
  const steps = decodeArray(Uint16Array, surface.positions);
  return {
    time: surface.time,  // time stamp of the image whose pose in the world of the surface is `pose`
    pose: surface.pose,
    positions: Float32Array.from(steps, (step, i) => surface.corner[i % 3] + surface.step * step),
    colors: decodeArray(Uint8Array, surface.colors),
    triangles: decodeArray(Uint32Array, surface.triangles),
  };
}

function jpegUrl(base64) {
  return "data:image/jpeg;base64," + base64;
}

// The keyframes of an earlier run. `name` may be empty.
function decodeSession({name, positions}) {
  return {name, positions: decodeArray(Float32Array, positions)};
}

class RunModel extends EventTarget {
  // `surface`: data of the fused surface; null if there is none.
  constructor(data, surface) {
    super();
    this.info = data;
    this.count = 0;
    this.current = 0;
    this.span = null;  // [from, to] seconds of the plots; null: the whole run
    this.columns = {};
    for (const [name, Type] of FRAME_COLUMNS) this.columns[name] = new Type(0);
    this.views = [];  // by ascending frame
    this.map = {
      lines: new Float32Array(0),
      axes: new Uint8Array(0),
      planes: new Float32Array(0),
      planeAxes: new Uint8Array(0),
      points: new Float32Array(0),
      sessions: []
    };
    this.axes = data.axes || null;
    this.groundTruth = decodeArray(Float32Array, data.ground_truth);
    this.truthName = data.truth_name || "ground truth";
    this.odometry = decodeArray(Float32Array, data.odometry);  // positions before loops, or empty
    this.surface = surface && decodeSurface(surface);
    this.setPlaces(data);
    this.addFrames(data.frames);
    this.setMap(data.map);
    this.addViews(data.views);
    // A frame in the middle shows more than the first one.
    const middle = this.viewOf(Math.floor(this.count / 2));
    this.current = middle ? middle.frame : Math.floor(this.count / 2);
  }

  widthOf(column) {
    return column[2] || this.info.stages.length;
  }

  // Adds frames, or replaces those from frames.first on.
  addFrames(frames) {
    if (!frames || frames.first > this.count) return;
    for (const column of FRAME_COLUMNS) {
      const [name, Type] = column;
      this.columns[name] = spliceArray(
          this.columns[name], frames.first * this.widthOf(column), decodeArray(Type, frames[name]));
    }
    this.count = this.columns.status.length;
  }

  // Loops as pairs of frames, the first frame that was found in the map of earlier runs or -1, and
  // the images of that place or null.
  setPlaces({loops, found, place}) {
    this.loops = loops || [];
    this.found = found === undefined ? -1 : found;
    this.place = place || null;
  }

  // Other poses of the first frames.
  moveFrames(moved) {
    if (!moved) return;
    for (const [name, Type] of [["pose", Float32Array], ["submap", Uint16Array]]) {
      const values = decodeArray(Type, moved[name]);
      this.columns[name].set(values.subarray(0, this.columns[name].length));
    }
  }

  // Whether the pose of a frame can be drawn.
  hasPose(frame) {
    return frame >= 0 && frame < this.count && this.columns.submap[frame] !== NO_SUBMAP &&
        this.columns.pose.subarray(7 * frame, 7 * frame + 7).every(Number.isFinite);
  }

  // The submaps that poses refer to, with their first frames, in order of these.
  submaps() {
    const found = new Map();
    for (let i = 0; i < this.count; ++i) {
      const number = this.columns.submap[i];
      if (number !== NO_SUBMAP && !found.has(number)) found.set(number, {number, first: i});
    }
    return [...found.values()];
  }

  setMap(map) {
    if (!map) return;
    this.map = {
      lines: decodeArray(Float32Array, map.lines),   // start and end, metres
      axes: decodeArray(Uint8Array, map.line_axes),  // 0, 1, 2; 3: no axis
      planes: decodeArray(Float32Array, map.planes && map.planes.triangles),  // three corners
      planeAxes: decodeArray(Uint8Array, map.planes && map.planes.axes),      // of each triangle
      points: decodeArray(Float32Array, map.points),
      sessions: (map.sessions || []).map(decodeSession),
    };
    if (map.axes) this.axes = map.axes;
  }

  addViews(views) {
    for (const view of views || []) {
      const decoded = {
        frame: view.frame,
        url: jpegUrl(view.jpeg),
        points: decodeArray(Uint16Array, view.points),
        pointDepth: decodeArray(Uint8Array, view.point_depth),
        lines: decodeArray(Uint16Array, view.lines),
        lineColors: decodeArray(Uint8Array, view.line_colors),
      };
      const at = this.views.findIndex((other) => other.frame >= view.frame);
      if (at < 0) this.views.push(decoded);
      else this.views.splice(at, this.views[at].frame === view.frame ? 1 : 0, decoded);
    }
  }

  notifyData() {
    this.dispatchEvent(new Event("data"));
  }

  // Duration of the run: a frame lasts until the next one, the last as long as the average.
  duration() {
    if (this.count === 0) return 1;
    const last = this.columns.time[this.count - 1];
    return last + (this.count > 1 ? last / (this.count - 1) : 1);
  }

  setFrame(index) {
    const frame = clamp(Math.round(index), 0, Math.max(0, this.count - 1));
    if (frame === this.current) return;
    this.current = frame;
    this.dispatchEvent(new Event("frame"));
  }

  // Index of the frame with a time stamp, to 5 ms as in msc_vo fuse; -1 if there is none.
  frameAt(timestamp) {
    const seconds = timestamp - this.info.start;
    return this.columns.time.findIndex((time) => Math.abs(time - seconds) < 5e-3);
  }

  setTime(seconds) {
    this.setFrame(lastNotAbove(this.columns.time, seconds));
  }

  setSpan(span) {
    if (span) {
      const shortest = Math.min(this.duration(), 0.1);
      const length = Math.max(span[1] - span[0], shortest);
      const from = clamp(span[0], 0, Math.max(0, this.duration() - length));
      span = length >= this.duration() ? null : [from, from + length];
    }
    this.span = span;
    this.dispatchEvent(new Event("span"));
  }

  // The view of a frame, or else the nearest one before it; null if there is none.
  viewOf(frame) {
    let found = null;
    for (const view of this.views) {
      if (view.frame > frame) break;
      found = view;
    }
    return found || this.views[0] || null;
  }

  // A value of a column with several numbers per frame.
  value(name, frame, component = 0) {
    const column = FRAME_COLUMNS.find((candidate) => candidate[0] === name);
    return this.columns[name][frame * this.widthOf(column) + component];
  }

  status(frame) {
    return STATUS_NAMES[this.columns.status[frame]] || "lost";
  }
}

// A color of the style sheet, such as "axis-0".
function themeColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

// Calls `redraw` whenever light and dark change.
function onThemeChange(redraw) {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
}
