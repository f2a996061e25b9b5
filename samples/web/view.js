// The scene in 3D: the model, a camera that can be turned, the cursor, and the surface point under a pointer.
// SPDX-License-Identifier: MIT
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const UP = new THREE.Vector3(0, 1, 0);
const CURSOR = 0.018; // of the model's size
const HEAD = 0.05; // length of the needle's head, of the model's size

// Without reflections: metals would be black, and each of their shaders takes a software renderer 0.1 s.
function matt({ color, map, vertexColors, flatShading, side, transparent, opacity, alphaTest }) {
  return new THREE.MeshLambertMaterial({ color, map, vertexColors, flatShading, side, transparent, opacity, alphaTest });
}

// Reads the model in a .glb and loads no other files: an untrusted file may name images on any host.
export async function read(bytes) {
  const manager = new THREE.LoadingManager().setURLModifier((url) => (/^(data|blob):/.test(url) ? url : "data:,"));
  const { scene } = await new GLTFLoader(manager).parseAsync(bytes, "");
  scene.traverse((part) => {
    if (part.isMesh) {
      part.material = matt(part.material);
    }
  });
  return scene;
}

export class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.001, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.mouseButtons = { LEFT: null, MIDDLE: THREE.MOUSE.PAN, RIGHT: THREE.MOUSE.ROTATE };
    this.controls.touches = { ONE: null, TWO: THREE.TOUCH.DOLLY_ROTATE };
    this.controls.enableZoom = true;
    const sun = new THREE.DirectionalLight(0xffffff, 2);
    sun.position.set(0.4, 1, 0.6);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x667788, 1.6), sun);
    // The same class of material as the model's: each further class takes a software renderer 0.05 s at the first
    // touch.
    const orange = new THREE.MeshLambertMaterial({ color: 0xd9662b });
    this.cursor = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), orange);
    this.shaft = new THREE.Mesh(new THREE.CylinderGeometry(0.004, 0.004, 1, 8).translate(0, 0.5, 0), orange);
    this.head = new THREE.Mesh(new THREE.ConeGeometry(0.3 * HEAD, HEAD, 16).translate(0, -HEAD / 2, 0), orange);
    this.needle = new THREE.Group().add(this.shaft, this.head);
    this.cursor.visible = this.needle.visible = false;
    this.scene.add(this.cursor, this.needle);
    this.ray = new THREE.Raycaster();
    this.model = null;
    this.changed = true; // since the last drawing
    this.controls.addEventListener("change", () => {
      this.changed = true;
    });
  }

  show(model) {
    if (this.model) {
      this.scene.remove(this.model);
    }
    this.model = model;
    this.scene.add(this.model);
    this.model.updateWorldMatrix(true, true);
    const sphere = new THREE.Box3().setFromObject(this.model).getBoundingSphere(new THREE.Sphere());
    this.size = sphere.radius;
    this.controls.target.copy(sphere.center);
    const narrow = Math.max(1, this.canvas.clientHeight / Math.max(1, this.canvas.clientWidth));
    const away = new THREE.Vector3(0, 1.6, 2).multiplyScalar(1.1 * narrow * sphere.radius);
    this.camera.position.copy(sphere.center).add(away);
    this.camera.near = sphere.radius / 100;
    this.camera.far = sphere.radius * 100;
    this.camera.updateProjectionMatrix();
    this.cursor.scale.setScalar(CURSOR * sphere.radius);
    this.controls.update();
    this.changed = true;
  }

  // The surface under a pointer: {point, normal} in the scene, or null.
  pick(event) {
    const box = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(
      (2 * (event.clientX - box.left)) / box.width - 1,
      1 - (2 * (event.clientY - box.top)) / box.height,
    );
    this.ray.setFromCamera(at, this.camera);
    return this.meet();
  }

  // The surface under a point, from above it along its normal.
  pickBelow(point, normal) {
    const n = new THREE.Vector3(...normal);
    this.ray.set(new THREE.Vector3(...point).addScaledVector(n, this.size), n.negate());
    return this.meet();
  }

  meet() {
    const hit = this.model && this.ray.intersectObject(this.model, true)[0];
    if (!hit) {
      return null;
    }
    const normal = hit.face.normal.clone().transformDirection(hit.object.matrixWorld);
    if (normal.dot(this.ray.ray.direction) > 0) {
      normal.negate();
    }
    return { point: hit.point.toArray(), normal: normal.toArray() };
  }

  // Moves the cursor on the surface, raised by the height; the force is an arrow, 1 N as long as a third of the model.
  moveCursor(proxy, height, normal, force) {
    this.changed ||= Boolean(proxy) || this.cursor.visible;
    this.cursor.visible = this.needle.visible = Boolean(proxy);
    if (!proxy) {
      return;
    }
    const n = new THREE.Vector3(...normal);
    this.cursor.position.set(...proxy).addScaledVector(n, height + CURSOR * this.size);
    const f = new THREE.Vector3(...force);
    this.needle.visible = f.length() > 0.001;
    this.needle.position.copy(this.cursor.position);
    const long = 0.02 + f.length() / 3;
    this.needle.scale.setScalar(this.size);
    this.needle.quaternion.setFromUnitVectors(UP, f.normalize());
    this.head.position.y = long;
    this.shaft.scale.y = Math.max(1e-3, long - HEAD);
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0 || !this.model) {
      return;
    }
    const ratio = Math.min(2, window.devicePixelRatio);
    if (this.canvas.width !== Math.floor(width * ratio) || this.canvas.height !== Math.floor(height * ratio)) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.changed = true;
    }
    if (!this.changed) {
      return;
    }
    this.changed = false;
    this.renderer.render(this.scene, this.camera);
  }
}
