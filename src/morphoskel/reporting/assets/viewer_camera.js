// A camera that turns around the shape, moved by mouse, touch and keys.

import { Vector3 } from "three";

const RADIANS = Math.PI / 180;
const KEY_STEP = 10 * RADIANS;
const ZOOM_STEP = 1.15;
const STEEPEST = 89.9 * RADIANS;
const FILLED = 0.94; // of the canvas, by the whole scene

export class OrbitView {
  /** `changed` is called after each move; on a page of its own the wheel always zooms, else once the canvas has focus. */
  constructor(canvas, camera, changed, wholePage) {
    Object.assign(this, { canvas, camera, changed, wholePage });
    this.target = new Vector3();
    this.home = null;
    this.pointers = new Map();
    // Where the view is a part of a page, a finger that moves up or down scrolls that page.
    canvas.style.touchAction = wholePage ? "none" : "pan-y";
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"])
      canvas.addEventListener(name, (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  /** Look at the whole scene; a reader's direction is kept from the scene before. */
  fit({ centre, up, radius, halfHeight, diagonal, azimuth, elevation }) {
    const first = this.home === null;
    const [x, y, z] = up === "z" ? [centre[0], centre[2], -centre[1]] : centre;
    this.home = { centre: new Vector3(x, y, z), radius, halfHeight, diagonal, azimuth, elevation };
    this.reset(!first);
  }

  reset(keepDirection = false) {
    if (!this.home) return;
    this.target.copy(this.home.centre);
    this.zoom = 1;
    if (!keepDirection) {
      this.azimuth = this.home.azimuth * RADIANS;
      this.elevation = this.home.elevation * RADIANS;
    }
    this.place();
  }

  /** How far away the camera is: at zoom 1 so far that the scene's cylinder just fits, seen from where it was first. */
  get distance() {
    const { radius, halfHeight, elevation } = this.home;
    const [sine, cosine] = [Math.sin(elevation * RADIANS), Math.cos(elevation * RADIANS)];
    const tangent = FILLED * Math.tan((this.camera.fov * RADIANS) / 2);
    let distance = 0;
    for (let degrees = 0; degrees < 360; degrees += 15)
      for (const height of [-halfHeight, halfHeight]) {
        const [across, near] = [radius * Math.sin(degrees * RADIANS), radius * Math.cos(degrees * RADIANS)];
        const towards = near * cosine + height * sine;
        const needed = Math.max(Math.abs(across) / this.camera.aspect, Math.abs(height * cosine - near * sine));
        distance = Math.max(distance, towards + needed / tangent);
      }
    return distance / this.zoom;
  }

  place() {
    if (!this.home) return;
    const { camera, target, distance, azimuth, elevation } = this;
    camera.position.set(
      target.x + distance * Math.sin(azimuth) * Math.cos(elevation),
      target.y + distance * Math.sin(elevation),
      target.z + distance * Math.cos(azimuth) * Math.cos(elevation),
    );
    camera.lookAt(target);
    const reach = this.home.diagonal + target.distanceTo(this.home.centre);
    camera.near = Math.max(distance - reach, distance / 100);
    camera.far = distance + reach;
    camera.updateProjectionMatrix();
    this.changed();
  }

  turn(across, along) {
    this.azimuth -= across;
    this.elevation = Math.max(-STEEPEST, Math.min(STEEPEST, this.elevation + along));
    this.place();
  }

  scale(factor) {
    this.zoom = Math.max(0.2, Math.min(100, this.zoom * factor));
    this.place();
  }

  /** Move the shape by pixels of the canvas. */
  shift(across, along) {
    const unit = (2 * this.distance * Math.tan((this.camera.fov * RADIANS) / 2)) / this.canvas.clientHeight;
    const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    this.target.addScaledVector(right, -across * unit).addScaledVector(up, along * unit);
    this.place();
  }

  press(event) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, event);
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before || !this.home) return;
    const [across, along] = [event.clientX - before.clientX, event.clientY - before.clientY];
    const other = [...this.pointers.values()].find(({ pointerId }) => pointerId !== event.pointerId);
    this.pointers.set(event.pointerId, event);
    if (other) {
      const gap = ({ clientX, clientY }) => Math.hypot(clientX - other.clientX, clientY - other.clientY);
      this.shift(across / 2, along / 2);
      if (gap(before) > 0) this.scale(gap(event) / gap(before));
    } else if (event.shiftKey || event.buttons & 6) this.shift(across, along);
    else {
      const turn = Math.PI / Math.min(this.canvas.clientWidth, this.canvas.clientHeight);
      this.turn(across * turn, along * turn);
    }
  }

  wheel(event) {
    if (!this.home || !(this.wholePage || event.ctrlKey || document.activeElement === this.canvas)) return;
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
    this.scale(Math.exp(-Math.max(-200, Math.min(200, pixels)) * 0.0015));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || !this.home) return;
    const actions = {
      ArrowLeft: () => this.turn(-KEY_STEP, 0),
      ArrowRight: () => this.turn(KEY_STEP, 0),
      ArrowUp: () => this.turn(0, -KEY_STEP),
      ArrowDown: () => this.turn(0, KEY_STEP),
      "+": () => this.scale(ZOOM_STEP),
      "=": () => this.scale(ZOOM_STEP),
      "-": () => this.scale(1 / ZOOM_STEP),
      r: () => this.reset(),
      R: () => this.reset(),
    };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }
}
