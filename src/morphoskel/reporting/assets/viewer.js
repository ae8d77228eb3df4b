// The interactive viewer: wires one <section class="morphoskel-viewer"> to its scenes.
//
// `make viewer` bundles this file, the modules beside it and what they use of three.js into viewer.min.js.

import { Color, DirectionalLight, Group, HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { OrbitView } from "./viewer_camera.js";
import { decodeScene } from "./viewer_data.js";
import { buildLayer } from "./viewer_layers.js";
import { barElement, layerRow } from "./viewer_panel.js";

const NO_WEBGL =
  "This browser offers no WebGL, so the shapes cannot be drawn. Switch on hardware acceleration, or open the page " +
  "in another browser.";
const TOO_OLD = "This browser is too old to unpack the shapes; it needs DecompressionStream (2023 or later).";

class Viewer {
  constructor(section) {
    this.section = section;
    this.find = (name) => section.querySelector(`.mv-${name}`);
    this.canvas = this.find("canvas");
    this.data = JSON.parse(this.find("data").textContent);
    this.hidden = new Map(); // by the name of a layer: readers' choices last from scene to scene
    this.chosenScalar = new Map();
    this.opacity = new Map();
    this.layers = [];
    this.frame = 0;
  }

  start() {
    if (typeof DecompressionStream === "undefined") return this.say(TOO_OLD);
    try {
      this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
    } catch {
      return this.say(NO_WEBGL);
    }
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.root = new Scene();
    this.shape = new Group(); // turned where z is up
    this.camera = new PerspectiveCamera(30);
    this.camera.add(this.light(-0.5, 0.9, 0.9, 2.1));
    this.root.add(this.shape, this.camera, new HemisphereLight(0xffffff, 0x9095a3, 1.2));
    const wholePage = document.documentElement.classList.contains("mv-page");
    this.view = new OrbitView(this.canvas, this.camera, () => this.draw(), wholePage);
    this.fillSelect();
    this.find("reset").addEventListener("click", () => this.view.reset());
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    new MutationObserver(() => this.recolour()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => this.draw());
    return this.show(0);
  }

  say(message) {
    this.find("message").textContent = message;
    this.find("message").hidden = !message;
    this.canvas.hidden = Boolean(message);
    this.section.dataset.state = message ? "failed" : "ready";
  }

  light(x, y, z, intensity) {
    const light = new DirectionalLight(0xffffff, intensity);
    light.position.set(x, y, z); // moves with the camera, to which it belongs
    return light;
  }

  fillSelect() {
    const label = this.find("scene");
    const select = label.querySelector("select");
    this.data.scenes.forEach((scene, index) => select.add(new Option(scene.name, String(index))));
    select.addEventListener("change", () => this.show(Number(select.value)));
    label.hidden = this.data.scenes.length < 2;
  }

  async show(index) {
    this.wanted = index;
    const scene = await decodeScene(this.data.scenes[index]);
    if (this.wanted !== index) return; // another was chosen meanwhile
    this.layers.forEach((layer) => layer.dispose());
    this.shape.clear();
    const tones = this.tones();
    this.layers = scene.layers.map((layer, order) => buildLayer(layer, order, scene, this.data.colours, tones));
    this.layers.forEach((layer) => this.shape.add(layer.object));
    this.shape.rotation.x = scene.up === "z" ? -Math.PI / 2 : 0;
    this.canvas.setAttribute("aria-label", `${this.section.getAttribute("aria-label")}: ${scene.name}`);
    this.fillPanel();
    this.say("");
    this.resize();
    this.view.fit(scene);
  }

  fillPanel() {
    const rows = this.layers.map((layer) => {
      const { name, visible, scalars, kind, opacity } = layer.data;
      layer.object.visible = !(this.hidden.get(name) ?? !visible);
      layer.choose(Math.min(this.chosenScalar.get(name) ?? 0, scalars.length - 1));
      if (kind === "mesh") layer.setOpacity(this.opacity.get(name) ?? opacity);
      return layerRow(layer, {
        toggled: (shown) => this.remember(this.hidden, name, !shown, () => (layer.object.visible = shown)),
        chosen: (scalar) => this.remember(this.chosenScalar, name, scalar, () => layer.choose(scalar)),
        faded: (value) => this.remember(this.opacity, name, value, () => layer.setOpacity(value)),
      });
    });
    this.find("layers").replaceChildren(this.find("layers").querySelector("legend"), ...rows);
    this.fillBars();
  }

  remember(choices, name, value, apply) {
    choices.set(name, value);
    apply();
    this.fillBars();
    this.draw();
  }

  // One bar for each quantity that a visible layer is coloured by; layers of one label share their scale.
  fillBars() {
    const shown = new Map();
    for (const layer of this.layers) if (layer.object.visible && layer.scale) shown.set(layer.scale.label, layer.scale);
    this.find("bars").replaceChildren(...[...shown.values()].map((scale) => barElement(scale, this.data.colours)));
  }

  tones() {
    const style = getComputedStyle(this.section);
    const tone = (name) => new Color(style.getPropertyValue(`--mv-${name}`).trim());
    return { muted: tone("muted"), strong: tone("strong") };
  }

  recolour() {
    const tones = this.tones();
    this.layers.forEach((layer) => layer.setTone(tones));
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.view.place();
  }

  // Nothing moves by itself, so nothing is drawn until something changes.
  draw() {
    if (this.frame || this.section.dataset.state !== "ready") return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      const { height } = this.renderer.domElement; // in device pixels, as the size of points is
      this.layers.forEach((layer) => layer.beforeDraw(height / (2 * Math.tan((this.camera.fov * Math.PI) / 360))));
      this.renderer.render(this.root, this.camera);
    });
  }
}

const start = () => {
  for (const section of document.querySelectorAll(".morphoskel-viewer:not([data-state])")) {
    section.dataset.state = "loading";
    const viewer = new Viewer(section);
    Promise.resolve()
      .then(() => viewer.start())
      .catch((error) => {
        viewer.say(`The shapes cannot be drawn: ${error.message}`);
        console.error(error);
      });
  }
};
if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
else start();
