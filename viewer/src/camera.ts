// The camera turns about a point of the part: drag to turn, with the right button or Shift to shift, wheel to go near.
import { PerspectiveCamera, Quaternion, Vector3 } from "three";

export class Orbit {
  readonly camera = new PerspectiveCamera(30, 1, 0.001, 100);
  readonly target = new Vector3();
  readonly turn = new Quaternion();
  distance = 5;
  whole = 5;
  changed: () => void = () => {};

  constructor() {
    this.home();
  }

  /// Looks at everything from a corner with z upward, from the side that a cut takes away.
  home(): void {
    this.target.set(0, 0, 0);
    const about = new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), (Math.PI * 4) / 5);
    this.turn.setFromAxisAngle(new Vector3(1, 0, 0), (Math.PI * 68) / 180).premultiply(about);
    this.distance = this.whole;
  }

  apply(width: number, height: number): void {
    const { camera } = this;
    camera.aspect = width / Math.max(1, height);
    camera.fov = camera.aspect >= 1 ? 30 : (2 * Math.atan(Math.tan(Math.PI / 12) / camera.aspect) * 180) / Math.PI;
    camera.near = Math.max(this.distance * 1e-3, this.distance - 6);
    camera.far = this.distance + 6;
    camera.position.set(0, 0, this.distance).applyQuaternion(this.turn).add(this.target);
    camera.quaternion.copy(this.turn);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  direction(): Vector3 {
    return new Vector3(0, 0, 1).applyQuaternion(this.turn);
  }

  rotate(dx: number, dy: number): void {
    const step = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), -dx);
    step.multiply(new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), -dy));
    this.turn.multiply(step).normalize();
    this.changed();
  }

  /// By shares of the window's height.
  shift(dx: number, dy: number): void {
    const high = 2 * this.distance * Math.tan((this.camera.fov * Math.PI) / 360);
    this.target.add(new Vector3(-dx * high, dy * high, 0).applyQuaternion(this.turn));
    this.changed();
  }

  zoom(factor: number): void {
    this.distance = Math.min(40, Math.max(1e-5, this.distance * factor));
    this.changed();
  }

  read(): number[] {
    const { turn, target } = this;
    return [turn.x, turn.y, turn.z, turn.w, target.x, target.y, target.z, this.distance].map((x) => Number(x.toPrecision(6)));
  }

  write(view: number[]): void {
    if (view.length !== 8 || !(view[7] > 0) || Math.hypot(view[0], view[1], view[2], view[3]) === 0) return;
    this.turn.set(view[0], view[1], view[2], view[3]).normalize();
    this.target.set(view[4], view[5], view[6]);
    this.distance = Math.min(40, Math.max(1e-5, view[7]));
  }

  /// Mouse, pen and fingers. `wheel` gets steps of the wheel and whether Shift is down, and says whether it took them.
  listen(canvas: HTMLCanvasElement, wheel: (steps: number, shift: boolean) => boolean, click: (x: number, y: number) => void): void {
    const down = new Map<number, { x: number; y: number }>();
    let moved = 0, spread = 0;
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      if (down.size === 0) moved = 0;
      down.set(event.pointerId, { x: event.clientX, y: event.clientY });
      spread = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const last = down.get(event.pointerId);
      if (!last) return;
      const dx = event.clientX - last.x, dy = event.clientY - last.y;
      moved += Math.abs(dx) + Math.abs(dy);
      last.x = event.clientX;
      last.y = event.clientY;
      if (down.size === 2) {
        const [one, other] = [...down.values()];
        const now = Math.hypot(one.x - other.x, one.y - other.y);
        if (spread > 0 && now > 0) this.zoom(spread / now);
        spread = now;
        this.shift(dx / 2 / canvas.clientHeight, dy / 2 / canvas.clientHeight);
      } else if ((event.buttons & 6) !== 0 || event.shiftKey) this.shift(dx / canvas.clientHeight, dy / canvas.clientHeight);
      else this.rotate((dx / canvas.clientHeight) * 4, (dy / canvas.clientHeight) * 4);
    });
    const up = (event: PointerEvent) => {
      const was = down.delete(event.pointerId);
      if (was && event.type === "pointerup" && moved < 5 && down.size === 0) click(event.offsetX, event.offsetY);
      spread = 0;
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      // Shift makes of a wheel one across on some systems.
      const delta = event.deltaY !== 0 ? event.deltaY : event.deltaX;
      const steps = delta / (event.deltaMode === 0 ? 100 : 3);
      if (!wheel(steps, event.shiftKey)) this.zoom(1.15 ** steps);
    }, { passive: false });
  }
}
