// The scene in 3D: the model with its ridges, a camera that can be turned, a lens, the cursor, and rays under a pointer.
// SPDX-License-Identifier: MIT
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { dispose } from "./model.js";
import { survey } from "./ridges.js";

export { read } from "./model.js";

const UP = new THREE.Vector3(0, 1, 0);
const CURSOR = 0.018; // of the model's size
const HEAD = 0.05; // length of the needle's head, of the model's size
const LENS_M = 0.006;
const MARGIN = 0.94; // of the view's half width that a model may fill
const TINTS = [0xe9b949, 0xd97b66, 0x7fa8c9, 0x8fb573, 0xa98fc4]; // of our models' surfaces

export class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.autoClear = false;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.001, 100);
    this.lens = new THREE.PerspectiveCamera(20, 1, 0.001, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.mouseButtons = { LEFT: null, MIDDLE: THREE.MOUSE.PAN, RIGHT: THREE.MOUSE.ROTATE };
    this.controls.touches = { ONE: null, TWO: THREE.TOUCH.DOLLY_ROTATE };
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
    this.caster = new THREE.Raycaster();
    this.model = null;
    this.touched = null; // {point, normal} of the last contact
    this.changed = true; // since the last drawing
    this.controls.addEventListener("change", () => {
      this.changed = true;
    });
  }

  // keepsCamera: the model is the present one, changed.
  show(model, keepsCamera = false) {
    if (this.model) {
      this.scene.remove(this.model);
      dispose(this.model);
    }
    this.model = model;
    this.touched = null;
    this.scene.add(this.model);
    this.model.updateWorldMatrix(true, true);
    this.box = new THREE.Box3().setFromObject(this.model);
    this.size = this.box.getBoundingSphere(new THREE.Sphere()).radius;
    this.camera.near = this.size / 100;
    this.camera.far = this.size * 100;
    this.cursor.scale.setScalar(CURSOR * this.size);
    if (!keepsCamera) {
      this.box.getCenter(this.controls.target);
      this.place(new THREE.Vector3(0, 1.9, 2));
    }
    this.changed = true;
  }

  // Puts the camera in a direction from the model, just far enough to see all of it.
  place(direction) {
    const { clientWidth, clientHeight } = this.canvas;
    const tall = MARGIN * Math.tan((Math.PI * this.camera.fov) / 360);
    const wide = tall * (clientWidth / Math.max(1, clientHeight) || 1);
    const back = direction.clone().normalize();
    const right = UP.clone().cross(back).normalize();
    const up = back.clone().cross(right);
    let far = 0;
    for (let i = 0; i < 8; i++) {
      const corner = new THREE.Vector3(...["x", "y", "z"].map((axis, k) => this.box[i & (1 << k) ? "max" : "min"][axis]))
        .sub(this.controls.target);
      far = Math.max(far, corner.dot(back) + Math.abs(corner.dot(right)) / wide, corner.dot(back) + Math.abs(corner.dot(up)) / tall);
    }
    this.camera.position.copy(this.controls.target).addScaledVector(back, far);
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  // The camera, from its target, in units of the model's size.
  get pose() {
    return this.camera.position.clone().sub(this.controls.target).divideScalar(this.size).toArray();
  }

  set pose(position) {
    this.camera.position.set(...position).multiplyScalar(this.size).add(this.controls.target);
    this.controls.update();
  }

  // rad to the side and up; nearer by a factor.
  turn(side, up, factor) {
    const away = new THREE.Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    away.theta += side;
    away.phi = Math.max(0.05, Math.min(Math.PI - 0.05, away.phi + up));
    away.radius *= factor;
    this.camera.position.setFromSpherical(away).add(this.controls.target);
    this.controls.update();
  }

  aim(event) {
    const box = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
    this.caster.setFromCamera(at, this.camera);
    return this.caster.ray;
  }

  // The line of sight under a pointer: from (3), to (3).
  ray(event) {
    const { origin, direction } = this.aim(event);
    return [...origin, ...origin.clone().addScaledVector(direction, this.camera.far)];
  }

  // The mesh under a pointer: {node, surface}, or null. It tests every triangle: for clicks only.
  meshAt(event) {
    this.aim(event);
    return (this.model && this.caster.intersectObject(this.model, true)[0]?.object.userData) ?? null;
  }

  // The nodes without ridges: {node, name}.
  get parts() {
    const found = new Map();
    this.model?.traverse(({ isMesh, userData }) => isMesh && userData.surface < 0 && found.set(userData.node, userData));
    return [...found.values()];
  }

  // The node of a surface in the file; undefined before findRidges().
  nodeOf(surface) {
    let node;
    this.model?.traverse(({ userData }) => {
      node = userData.surface === surface ? userData.node : node;
    });
    return node;
  }

  async findRidges(ask, isOurs) {
    const { model } = this;
    await survey(model, this.size, ask, () => this.model === model);
    model.traverse(({ isMesh, material, userData }) => {
      if (isMesh && isOurs && userData.surface >= 0) {
        material.color.set(TINTS[userData.surface % TINTS.length]);
      }
    });
    this.changed = true;
  }

  // A surface's colour, over its texture.
  paint(surface, color) {
    this.model?.traverse(({ isMesh, material, userData }) => isMesh && userData.surface === surface && material.color.set(color));
    this.changed = true;
  }

  // The ridges of each surface, as they are set.
  setRidges(surfaces) {
    this.model?.traverse(({ isMesh, material, userData }) => {
      if (isMesh && surfaces[userData.surface]) {
        material.userData.ridges.value.fromArray(surfaces[userData.surface].feel);
      }
    });
    this.changed = true;
  }

  // Moves the cursor on the surface, raised by the height; the force is an arrow, 1 N as long as a third of the model.
  moveCursor(proxy, height, normal, force) {
    this.changed ||= Boolean(proxy) || this.cursor.visible;
    this.cursor.visible = this.needle.visible = Boolean(proxy);
    if (!proxy) {
      return;
    }
    const n = new THREE.Vector3(...normal);
    this.touched = { point: new THREE.Vector3(...proxy), normal: n };
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

  // lens: the element in whose place the touched surface is drawn, seen along its normal.
  draw(lens) {
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
    this.renderer.setViewport(0, 0, width, height);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    if (this.touched && lens.offsetWidth > 0) {
      this.drawLens(lens, height);
    }
  }

  drawLens({ offsetLeft, offsetTop, offsetWidth: side }, height) {
    const { point, normal } = this.touched;
    const away = 0.5 * LENS_M / Math.tan((Math.PI * this.lens.fov) / 360);
    this.lens.near = 0.5 * away;
    this.lens.far = 2 * away;
    this.lens.up.copy(UP).applyQuaternion(this.camera.quaternion);
    this.lens.position.copy(point).addScaledVector(normal, away);
    this.lens.lookAt(point);
    this.lens.updateProjectionMatrix();
    const shown = [this.cursor.visible, this.needle.visible];
    this.cursor.visible = this.needle.visible = false;
    const place = [offsetLeft + 1, height - offsetTop - side + 1, side - 2, side - 2];
    this.renderer.setScissorTest(true);
    this.renderer.setScissor(...place);
    this.renderer.setViewport(...place);
    this.renderer.clear();
    this.renderer.render(this.scene, this.lens);
    this.renderer.setScissorTest(false);
    [this.cursor.visible, this.needle.visible] = shown;
  }
}
