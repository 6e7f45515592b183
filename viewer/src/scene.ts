// What is drawn, by three.js: solid triangles with their edges, a ghost, points, segments, what an entry concerns, a halo.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, GLSL3, LineSegments, Mesh as Drawn, Points, Scene, ShaderMaterial,
  Vector4, WebGLRenderer,
} from "three";
import type { Orbit } from "./camera";
import type { Plane, Triangles } from "./shown";

// One program for triangles. Normals come from derivatives, so that each triangle is flat; edges from the corner's number.
const vertexShader = `
in vec4 paint;
out vec3 at;
out vec3 barycentric;
flat out vec3 colour;
flat out int edges;
out vec3 place;
void main() {
  int corner = gl_VertexID % 3;
  barycentric = vec3(corner == 0, corner == 1, corner == 2);
  colour = paint.rgb;
  edges = int(paint.a * 255.0 + 0.5);
  place = position;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  at = seen.xyz;
  gl_Position = projectionMatrix * seen;
}`;
const fragmentShader = `
precision highp float;
in vec3 at;
in vec3 barycentric;
flat in vec3 colour;
flat in int edges;
in vec3 place;
out vec4 fragment;
uniform vec4 plane;
uniform float opacity;
uniform float lines;
uniform vec3 ink;
void main() {
  if (dot(plane.xyz, place) > plane.w) discard;
  vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
  float light = 0.45 + 0.55 * abs(normal.z);
  vec3 shaded = colour * light;
  if (lines > 0.0 && edges != 0) {
    vec3 far = barycentric / max(fwidth(barycentric), 1e-9);
    float near = 9.0;
    if ((edges & 1) != 0) near = min(near, far.z);
    if ((edges & 2) != 0) near = min(near, far.x);
    if ((edges & 4) != 0) near = min(near, far.y);
    float dense = max(fwidth(barycentric.x), max(fwidth(barycentric.y), fwidth(barycentric.z)));
    shaded = mix(shaded, ink, 0.75 * lines * (1.0 - smoothstep(0.4, 1.2, near)) * (1.0 - smoothstep(0.3, 0.9, dense)));
  }
  fragment = vec4(shaded, opacity);
}`;

const everything = new Vector4(0, 0, 0, 1);

function triangleMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader, fragmentShader, glslVersion: GLSL3, side: DoubleSide,
    uniforms: {
      plane: { value: everything.clone() }, opacity: { value: 1 }, lines: { value: 1 }, ink: { value: new Color(0x101820) },
    },
  });
}

/// Points that keep their size: disks, or the ring of a halo.
function pointMaterial(size: number, colour: number, ring: boolean): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3, depthTest: !ring, depthWrite: false, transparent: true,
    uniforms: { size: { value: size }, colour: { value: new Color(colour) }, plane: { value: everything.clone() } },
    vertexShader: `
uniform float size;
out vec3 place;
void main() {
  place = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_Position.z -= 0.0005 * gl_Position.w;
  gl_PointSize = size;
}`,
    fragmentShader: `
precision highp float;
uniform vec3 colour;
uniform vec4 plane;
in vec3 place;
out vec4 fragment;
void main() {
  if (dot(plane.xyz, place) > plane.w) discard;
  float r = length(gl_PointCoord - 0.5) * 2.0;
  ${ring ? "float a = smoothstep(0.68, 0.74, r) * (1.0 - smoothstep(0.92, 1.0, r));" : "float a = 1.0 - smoothstep(0.8, 1.0, r);"}
  if (a < 0.02) discard;
  fragment = vec4(colour, a);
}`,
  });
}

function lineMaterial(colour: number, over: boolean): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3, depthTest: !over, transparent: over,
    uniforms: { colour: { value: new Color(colour) }, plane: { value: everything.clone() } },
    vertexShader: `
out vec3 place;
void main() {
  place = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_Position.z -= 0.0003 * gl_Position.w;
}`,
    fragmentShader: `
precision highp float;
uniform vec3 colour;
uniform vec4 plane;
in vec3 place;
out vec4 fragment;
void main() {
  if (dot(plane.xyz, place) > plane.w) discard;
  fragment = vec4(colour, 1.0);
}`,
  });
}

function setTriangles(drawn: Drawn, triangles: Triangles | null): void {
  drawn.geometry.dispose();
  const geometry = new BufferGeometry(), count = triangles?.count ?? 0;
  if (triangles && count > 0) {
    geometry.setAttribute("position", new BufferAttribute(triangles.positions.subarray(0, 9 * count), 3));
    geometry.setAttribute("paint", new BufferAttribute(triangles.colours.subarray(0, 12 * count), 4, true));
  }
  drawn.geometry = geometry;
  drawn.visible = count > 0;
}

function setPlaces(drawn: Points | LineSegments, places: Float32Array): void {
  drawn.geometry.dispose();
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  drawn.geometry = geometry;
  drawn.visible = places.length > 0;
}

export class View {
  readonly renderer: WebGLRenderer;
  private scene = new Scene();
  private solid = new Drawn(new BufferGeometry(), triangleMaterial());
  private cap = new Drawn(new BufferGeometry(), triangleMaterial());
  private dangling = new Drawn(new BufferGeometry(), triangleMaterial());
  private ghost = new Drawn(new BufferGeometry(), triangleMaterial());
  private over = new Drawn(new BufferGeometry(), triangleMaterial());
  private added = new Points(new BufferGeometry(), pointMaterial(7, 0xd03030, false));
  private segments = new LineSegments(new BufferGeometry(), lineMaterial(0x2040d0, false));
  private overLines = new LineSegments(new BufferGeometry(), lineMaterial(0xd00020, true));
  private overPoints = new Points(new BufferGeometry(), pointMaterial(10, 0xd00020, false));
  private halo = new Points(new BufferGeometry(), pointMaterial(44, 0xff7000, true));
  private wanted = false;

  constructor(readonly canvas: HTMLCanvasElement, readonly orbit: Orbit) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false });
    const all = [this.solid, this.cap, this.dangling, this.ghost, this.over, this.added, this.segments, this.overLines, this.overPoints, this.halo];
    all.forEach((drawn, i) => {
      drawn.frustumCulled = false;
      drawn.renderOrder = i;
      this.scene.add(drawn);
    });
    const offset = (drawn: Drawn, amount: number) => {
      const material = drawn.material as ShaderMaterial;
      material.polygonOffset = true;
      material.polygonOffsetFactor = amount;
      material.polygonOffsetUnits = amount;
    };
    offset(this.dangling, -1);
    const ghost = this.ghost.material as ShaderMaterial;
    Object.assign(ghost, { transparent: true, depthWrite: false });
    ghost.uniforms.opacity.value = 0.09;
    ghost.uniforms.lines.value = 0;
    const over = this.over.material as ShaderMaterial;
    Object.assign(over, { transparent: true, depthTest: false, depthWrite: false });
    over.uniforms.opacity.value = 0.55;
    (this.overPoints.material as ShaderMaterial).depthTest = false;
    for (const drawn of all) drawn.visible = false;
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  setSolid(triangles: Triangles, cap: Triangles, dangling: Triangles, plane: Plane | null, clip: boolean): void {
    setTriangles(this.solid, triangles);
    setTriangles(this.cap, cap);
    setTriangles(this.dangling, dangling);
    const kept = plane && clip ? new Vector4(...plane.normal, plane.offset + 1e-6) : everything;
    const side = plane ? new Vector4(...plane.normal, plane.offset + 1e-6) : everything;
    (this.solid.material as ShaderMaterial).uniforms.plane.value = kept;
    (this.dangling.material as ShaderMaterial).uniforms.plane.value = kept;
    for (const drawn of [this.added, this.segments]) (drawn.material as ShaderMaterial).uniforms.plane.value = side;
  }

  setEdges(on: boolean): void {
    for (const drawn of [this.solid, this.cap, this.dangling])
      (drawn.material as ShaderMaterial).uniforms.lines.value = on ? 1 : 0;
  }

  setGhost(triangles: Triangles | null): void {
    setTriangles(this.ghost, triangles);
  }

  setPoints(places: Float32Array): void {
    setPlaces(this.added, places);
  }

  setSegments(places: Float32Array): void {
    setPlaces(this.segments, places);
  }

  /// What an entry of a list concerns, drawn over everything; `ghostly` hides the solid.
  setOver(triangles: Triangles | null, lines: Float32Array, points: Float32Array, halo: Float32Array, ghostly: boolean): void {
    setTriangles(this.over, triangles);
    setPlaces(this.overLines, lines);
    setPlaces(this.overPoints, points);
    setPlaces(this.halo, halo);
    for (const drawn of [this.solid, this.cap, this.dangling, this.added, this.segments])
      drawn.visible = !ghostly && drawn.geometry.getAttribute("position") !== undefined;
  }

  setBackground(colour: string): void {
    this.renderer.setClearColor(new Color(colour));
    this.draw();
  }

  draw(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow(): void {
    this.wanted = false;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
    }
    for (const [drawn, size] of [[this.added, 7], [this.overPoints, 10], [this.halo, 44]] as const)
      (drawn.material as ShaderMaterial).uniforms.size.value = size * ratio;
    this.orbit.apply(width, height);
    this.renderer.render(this.scene, this.orbit.camera);
  }

  /// The picture as it is now, as a PNG.
  picture(): Promise<Blob | null> {
    this.drawNow();
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }
}
