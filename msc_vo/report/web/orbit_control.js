// Turns, moves and zooms a camera around a target, with mouse, touch and keys. The z axis points
// up.

class OrbitControl {
  // `onChange` is called after every change.
  constructor(element, camera, onChange) {
    this.element = element;
    this.camera = camera;
    this.onChange = onChange;
    this.enabled = true;
    this.home =
        {target: new THREE.Vector3(), distance: 5, azimuth: -0.35, elevation: 0.58, fov: 40};
    this.pointers = new Map();
    this.reset();
    element.addEventListener("pointerdown", (event) => this.onDown(event));
    element.addEventListener("pointermove", (event) => this.onMove(event));
    for (const name of ["pointerup", "pointercancel"]) {
      element.addEventListener(name, (event) => this.pointers.delete(event.pointerId));
    }
    element.addEventListener("wheel", (event) => this.onWheel(event), {passive: false});
    element.addEventListener("keydown", (event) => this.onKey(event));
    element.addEventListener("dblclick", () => this.reset());
    element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  // The viewpoint that reset() returns to.
  setHome(home) {
    this.home = Object.assign({}, this.home, home);
    this.reset();
  }

  reset() {
    const home = this.home;
    Object.assign(this, home, {target: home.target.clone()});
    this.update();
  }

  // Places the camera.
  update() {
    if (!this.enabled) return;
    this.elevation = clamp(this.elevation, -1.5707, 1.5707);
    const horizontal = Math.cos(this.elevation);
    const back = new THREE.Vector3(
        -Math.sin(this.azimuth) * horizontal, -Math.cos(this.azimuth) * horizontal,
        Math.sin(this.elevation));
    const camera = this.camera;
    camera.fov = this.fov;
    // Seen straight from above, the upper edge of the picture is the forward direction.
    camera.up.set(0, 0, 1);
    if (horizontal < 1e-3) camera.up.set(Math.sin(this.azimuth), Math.cos(this.azimuth), 0);
    camera.position.copy(this.target).addScaledVector(back, this.distance);
    camera.near = this.distance / 500;
    camera.far = this.distance * 50;
    camera.lookAt(this.target);
    camera.updateProjectionMatrix();
    this.onChange();
  }

  turn(dx, dy) {
    this.azimuth += 0.006 * dx;
    this.elevation += 0.006 * dy;
    this.update();
  }

  move(dx, dy) {
    const metersPerPixel =
        2 * this.distance * Math.tan(this.fov * Math.PI / 360) / this.element.clientHeight;
    const axes = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    this.camera.updateMatrixWorld();
    this.camera.matrixWorld.extractBasis(...axes);
    this.target.addScaledVector(axes[0], -dx * metersPerPixel);
    this.target.addScaledVector(axes[1], dy * metersPerPixel);
    this.update();
  }

  zoom(factor) {
    this.distance =
        clamp(this.distance * factor, this.home.distance / 100, this.home.distance * 20);
    this.update();
  }

  onDown(event) {
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  }

  onMove(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last || !this.enabled) return;
    const dx = event.clientX - last.x, dy = event.clientY - last.y;
    const before = this.pinch();
    Object.assign(last, {x: event.clientX, y: event.clientY});
    const after = this.pinch();
    if (before && after) {
      this.zoom(before / after);
      this.move(dx / 2, dy / 2);
    } else if (event.shiftKey || (event.buttons & 6)) {
      this.move(dx, dy);
    } else {
      this.turn(dx, dy);
    }
  }

  // Distance between two fingers; 0 with one.
  pinch() {
    if (this.pointers.size !== 2) return 0;
    const [a, b] = [...this.pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  }

  onWheel(event) {
    if (!this.enabled) return;
    event.preventDefault();
    this.zoom(Math.exp(0.0015 * clamp(event.deltaY, -200, 200)));
  }

  onKey(event) {
    if (!this.enabled || event.ctrlKey || event.metaKey || event.altKey) return;
    const steps = {ArrowLeft: [20, 0], ArrowRight: [-20, 0], ArrowUp: [0, 20], ArrowDown: [0, -20]};
    if (steps[event.key]) {
      if (event.shiftKey) this.move(...steps[event.key]);
      else this.turn(...steps[event.key]);
    } else if (event.key === "+" || event.key === "=") {
      this.zoom(0.85);
    } else if (event.key === "-") {
      this.zoom(1 / 0.85);
    } else if (event.key === "0") {
      this.reset();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }
}
