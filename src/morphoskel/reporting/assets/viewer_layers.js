// Turns the layers of a scene into objects of three.js.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Points,
  ShaderMaterial,
  SphereGeometry,
  SRGBColorSpace,
} from "three";
import { POINT_FRAGMENT, POINT_VERTEX, SURFACE_FRAGMENT, SURFACE_VERTEX } from "./viewer_shaders.js";

class DrawnLayer {
  constructor(data, object, scales, colours) {
    Object.assign(this, { data, object, scales });
    this.table = colours.map((hex) => new Color().setStyle(`#${hex}`, SRGBColorSpace));
    this.scale = null;
    this.tone = new Color();
    this.tints = new BufferAttribute(new Float32Array(3 * data.count), 3);
    this.colourBy(this.tints);
  }

  colourBy(tints) {
    this.object.geometry.setAttribute("color", tints);
  }

  /** Colour by the scalar of that number; by the tone if there is none. */
  choose(number) {
    const scalar = this.data.scalars[number];
    this.scale = scalar ? this.scales.get(scalar.label) : null;
    this.number = number;
    const range = scalar ? this.scale.high - this.scale.low : 0;
    for (let i = 0; i < this.data.count; i++) {
      let colour = this.tone;
      if (scalar) {
        const value = scalar.low + scalar.fractions[i] * (scalar.high - scalar.low);
        const place = range > 0 ? (value - this.scale.low) / range : 0;
        colour = this.table[Math.round(place * (this.table.length - 1))];
      }
      colour.toArray(this.tints.array, 3 * i);
    }
    this.tints.needsUpdate = true;
  }

  setTone(tones) {
    this.tone = tones[this.data.tone];
    this.choose(this.number);
  }

  beforeDraw() {}

  dispose() {
    this.object.traverse((part) => {
      part.geometry?.dispose();
      part.material?.dispose();
      if (part.isInstancedMesh) part.dispose();
    });
  }
}

class PointLayer extends DrawnLayer {
  constructor(data, scene, colours) {
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(data.positions, 3));
    const uniforms = { radius: { value: pointRadius(data, scene) }, pixels: { value: 1 } };
    const material = new ShaderMaterial({ vertexShader: POINT_VERTEX, fragmentShader: POINT_FRAGMENT, uniforms });
    super(data, new Points(geometry, material), scene.scales, colours);
    this.uniforms = uniforms;
  }

  beforeDraw(pixelsAtUnitDistance) {
    this.uniforms.pixels.value = pixelsAtUnitDistance;
  }
}

// Dots of few points are larger than those of many, so that both read as a surface and not as dust or a lump.
function pointRadius(data, scene) {
  return scene.diagonal * data.size * Math.min(0.006, Math.max(0.0008, 0.16 / Math.sqrt(data.count)));
}

class BallLayer extends DrawnLayer {
  constructor(data, scene, colours) {
    const [across, along] = data.count <= 300 ? [48, 32] : data.count <= 3000 ? [24, 16] : [12, 8];
    const balls = new InstancedMesh(new SphereGeometry(1, across, along), new MeshLambertMaterial(), data.count);
    const matrix = new Matrix4();
    for (let i = 0; i < data.count; i++) {
      // A ball of radius 0 would make a matrix without inverse; it is too small to be seen either way.
      const radius = Math.max(data.radii[i], 1e-6 * scene.diagonal);
      matrix.makeScale(radius, radius, radius).setPosition(...data.positions.subarray(3 * i, 3 * i + 3));
      balls.setMatrixAt(i, matrix);
    }
    super(data, balls, scene.scales, colours);
  }

  colourBy(tints) {
    this.object.instanceColor = new InstancedBufferAttribute(tints.array, 3);
    this.tints = this.object.instanceColor;
  }
}

class SegmentLayer extends DrawnLayer {
  constructor(data, scene, colours) {
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(data.positions, 3));
    geometry.setIndex(new BufferAttribute(data.elements, 1));
    super(data, new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true })), scene.scales, colours);
  }
}

// A first pass finds the depth of the triangles that are nearest to the viewer, a second one draws only those: so the
// veil is equally dense wherever it lies in folds, and triangles need not be sorted.
class MeshLayer extends DrawnLayer {
  constructor(data, order, scene, colours) {
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(data.positions, 3));
    geometry.setIndex(new BufferAttribute(data.elements, 1));
    geometry.computeVertexNormals();
    const uniforms = { opacity: { value: data.opacity } };
    const shared = { side: DoubleSide, transparent: true };
    const depth = new Mesh(geometry, new MeshBasicMaterial({ ...shared, colorWrite: false }));
    const shaders = { vertexShader: SURFACE_VERTEX, fragmentShader: SURFACE_FRAGMENT, uniforms };
    const veil = new Mesh(geometry, new ShaderMaterial({ ...shared, ...shaders, depthWrite: false }));
    [depth.renderOrder, veil.renderOrder] = [2 * order, 2 * order + 1];
    super(data, new Group().add(depth, veil), scene.scales, colours);
    this.uniforms = uniforms;
  }

  colourBy(tints) {
    this.object.children[0].geometry.setAttribute("color", tints); // both passes share it
  }

  setOpacity(opacity) {
    this.uniforms.opacity.value = opacity;
  }
}

/** Return the drawn layer, whose `object` is still to be added to the scene. */
export function buildLayer(data, order, scene, colours, tones) {
  const kinds = { points: PointLayer, balls: BallLayer, segments: SegmentLayer };
  const layer =
    data.kind === "mesh" ? new MeshLayer(data, order, scene, colours) : new kinds[data.kind](data, scene, colours);
  layer.tone = tones[data.tone];
  layer.object.traverse((part) => (part.frustumCulled = false)); // one shape fills the view; nothing to gain
  return layer;
}
