// The 3-D view: viewpoints, layers, and the camera that moves with the current frame.

// Rows right, forward, up of the view. With Manhattan axes, the one next to the mean up direction
// of the cameras is up, so that walls are upright and straight in the top view.
function viewRotation(model) {
  const rows = [0, 1, 2].map((i) => new THREE.Vector3().fromArray(model.info.view, 3 * i));
  let [right, , up] = rows;
  const directions = [];
  for (let i = 0; model.axes && i < 3; ++i) {
    const axis = new THREE.Vector3(model.axes[i], model.axes[3 + i], model.axes[6 + i]);
    directions.push(axis, axis.clone().negate());
  }
  const nearest = (direction) => directions.reduce(
      (best, axis) => (axis.dot(direction) > best.dot(direction) ? axis : best), directions[0]);
  if (directions.length > 0 && nearest(up).dot(up) > 0.8) {
    up = nearest(up);
    const flat = right.clone().addScaledVector(up, -right.dot(up)).normalize();
    right = nearest(flat).dot(flat) > 0.7 && Math.abs(nearest(flat).dot(up)) < 0.5 ? nearest(flat) :
                                                                                     flat;
  }
  const forward = new THREE.Vector3().crossVectors(up, right);
  return new THREE.Matrix4().makeBasis(right, forward, up).transpose();
}

// Center and radius (in coordinates of the view) of the trajectory and of most line ends.
function boundingSphere(model, rotation) {
  const bounds = [];
  const path = trajectoryOf(model);
  for (let axis = 0; axis < 3; ++axis) {
    const row = [0, 1, 2].map((i) => rotation.elements[4 * i + axis]);
    const along = (a, i) => row[0] * a[i] + row[1] * a[i + 1] + row[2] * a[i + 2];
    let low = Infinity, high = -Infinity;
    for (let i = 0; i < path.length; i += 3) {
      low = Math.min(low, along(path, i));
      high = Math.max(high, along(path, i));
    }
    const ends = [];
    for (let i = 0; i < model.map.lines.length; i += 3) ends.push(along(model.map.lines, i));
    ends.sort((a, b) => a - b);
    const cut = Math.floor(0.03 * ends.length);  // lines with wrong depth are no part of the scene
    if (ends.length > 0) {
      low = Math.min(low, ends[cut]);
      high = Math.max(high, ends[ends.length - 1 - cut]);
    }
    if (!(high >= low)) low = high = 0;
    bounds.push([low, high]);
  }
  const center = new THREE.Vector3(...bounds.map(([low, high]) => (low + high) / 2));
  const radius = Math.hypot(...bounds.map(([low, high]) => (high - low) / 2));
  return {center, radius: Math.max(radius, 0.3)};
}

// Azimuth of the mean viewing direction of the cameras, in coordinates of the view; 0 without one.
function meanAzimuth(model, rotation) {
  const sum = new THREE.Vector3(), pose = new THREE.Quaternion();
  for (let i = 0; i < model.count; ++i) {
    pose.fromArray(model.columns.pose, 7 * i + 3);
    if (model.hasPose(i)) sum.add(new THREE.Vector3(0, 0, 1).applyQuaternion(pose));
  }
  sum.applyMatrix4(rotation);
  return Math.hypot(sum.x, sum.y) > 0.2 * model.count ? Math.atan2(sum.x, sum.y) : 0;
}

// Names and keys of the views, and their viewpoints. The orbit is turned away from the viewing
// direction of the cameras, so that walls are not parallel to the picture.
const SCENE_VIEWS = {
  orbit: {key: "o", fov: 40, azimuth: -0.35, elevation: 0.55},
  top: {key: "t", fov: 6, azimuth: 0, elevation: Math.PI / 2},
  side: {key: "s", fov: 6, azimuth: 0, elevation: 0},
  camera: {key: "c"},
};

class SceneView {
  // `label`: element that follows the frame that was found in the map of earlier runs.
  constructor(model, canvas, image, label) {
    this.model = model;
    this.canvas = canvas;
    this.image = image;
    this.label = label;
    this.renderer = new THREE.WebGLRenderer(
        {canvas, antialias: true, alpha: true, preserveDrawingBuffer: true});
    this.scene = new THREE.Scene();
    this.world = new THREE.Group();
    this.world.matrixAutoUpdate = false;
    this.scene.add(this.world);
    this.layers = new SceneLayers(model, this.world);
    this.perspective = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
    this.recorded = new THREE.PerspectiveCamera();  // that of the run
    this.recorded.matrixAutoUpdate = false;
    this.control = new OrbitControl(canvas, this.perspective, () => this.draw());
    this.view = "orbit";
    this.isDrawing = false;
    this.fill();
    this.setView("orbit");
    model.addEventListener("data", () => {
      this.fill();
      this.onFrame();
    });
    model.addEventListener("frame", () => this.onFrame());
    onThemeChange(() => {
      this.fill();
      this.draw();
    });
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.onFrame();
  }

  fill() {
    const rotation = viewRotation(this.model);
    this.world.matrix.copy(rotation);
    this.world.matrixWorldNeedsUpdate = true;
    const sphere = boundingSphere(this.model, rotation);
    const last = this.sphere;
    const has_changed = !last || sphere.radius > 1.15 * last.radius ||
        sphere.center.distanceTo(last.center) > 0.15 * last.radius;
    if (has_changed || !this.model.info.live) this.sphere = sphere;
    this.layers.fill(this.sphere.radius);
    // The view follows a growing map until it is moved by hand.
    if (has_changed && this.view !== "camera" && !this.control.isTouched) this.setView(this.view);
  }

  setView(view) {
    this.view = view;
    const place = SCENE_VIEWS[view];
    this.control.enabled = view !== "camera";
    if (this.control.enabled) {
      const distance = 1.12 * this.sphere.radius / Math.sin(place.fov * Math.PI / 360);
      const close = view === "orbit" ? 0.7 : 0.8;
      const turned = view === "orbit" ? meanAzimuth(this.model, this.world.matrix) : 0;
      this.control.setHome({
        target: this.sphere.center,
        distance: close * distance,
        fov: place.fov,
        azimuth: place.azimuth + turned,
        elevation: place.elevation
      });
    }
    this.image.hidden = view !== "camera";
    this.onFrame();
  }

  toggleLayer(label) {
    this.layers.toggle(label);
    this.draw();
  }

  onFrame() {
    this.layers.moveCamera(this.model.current);
    if (this.view === "camera") this.followCamera();
    this.draw();
  }

  // Views the map as the camera of the current frame does, in front of its image.
  followCamera() {
    const {model, recorded} = this;
    if (model.count === 0) return;
    const {fx, fy, cx, cy, width, height} = model.info.camera;
    const scale = Math.min(this.canvas.clientWidth / width, this.canvas.clientHeight / height) || 1;
    // In pixels of the camera, whose centres are integers.
    const canvasWidth = this.canvas.clientWidth / scale;
    const canvasHeight = this.canvas.clientHeight / scale;
    const left = (width - canvasWidth) / 2 - 0.5, top = (height - canvasHeight) / 2 - 0.5;
    const near = 0.02;
    recorded.projectionMatrix.makePerspective(
        near * (left - cx) / fx, near * (left + canvasWidth - cx) / fx, near * (cy - top) / fy,
        near * (cy - top - canvasHeight) / fy, near, 1000);
    recorded.projectionMatrixInverse.getInverse(recorded.projectionMatrix);
    const flip = new THREE.Matrix4().makeRotationX(Math.PI);  // y up, looking along -z
    recorded.matrix.multiplyMatrices(this.world.matrix, poseMatrix(model, model.current))
        .multiply(flip);
    recorded.matrixWorldNeedsUpdate = true;
    const view = model.viewOf(model.current);
    if (view && this.image.src !== view.url) this.image.src = view.url;
    this.image.hidden = !view || view.frame !== model.current;
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio || 1, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.layers.setResolution(clientWidth, clientHeight);
    this.perspective.aspect = clientWidth / clientHeight;
    this.control.update();
    this.onFrame();
  }

  // Draws once, before the next repaint.
  draw() {
    if (this.isDrawing) return;
    this.isDrawing = true;
    requestAnimationFrame(() => {
      this.isDrawing = false;
      const isCamera = this.view === "camera";
      this.layers.show(isCamera);
      this.renderer.render(this.scene, isCamera ? this.recorded : this.perspective);
      this.placeLabel();
    });
  }

  placeLabel() {
    const {model, label, canvas} = this;
    label.hidden = !this.layers.found.visible;
    if (label.hidden) return;
    const time = formatNumber(model.value("time", model.found), 2);
    label.textContent = `found in the map: frame ${model.found}, ${time} s`;
    const at = new THREE.Vector3(...positionOf(model, model.found))
                   .applyMatrix4(this.world.matrix)
                   .project(this.perspective);
    label.hidden = Math.max(Math.abs(at.x), Math.abs(at.y), Math.abs(at.z)) > 1;
    label.style.left = `${(0.5 + 0.5 * at.x) * canvas.clientWidth}px`;
    label.style.top = `${(0.5 - 0.5 * at.y) * canvas.clientHeight}px`;
  }
}
