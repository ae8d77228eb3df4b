// Unpacks the arrays of a scene; scene_encoding.py packs them.

const STEPS = 65535;

async function inflate(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The bytes come in planes: all first bytes of the numbers, then all second ones, and so on.
async function unpack(text, Numbers) {
  const planes = await inflate(text);
  const width = Numbers.BYTES_PER_ELEMENT;
  const count = planes.length / width;
  const bytes = new Uint8Array(planes.length);
  for (let plane = 0; plane < width; plane++)
    for (let i = 0; i < count; i++) bytes[i * width + plane] = planes[plane * count + i];
  return new Numbers(bytes.buffer);
}

async function decodePositions(layer) {
  const steps = await unpack(layer.positions, Uint16Array);
  const positions = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; i++) {
    const low = layer.lower[i % 3];
    positions[i] = low + (steps[i] / STEPS) * (layer.upper[i % 3] - low);
  }
  return positions;
}

async function decodeElements(text) {
  const differences = await unpack(text, Int32Array);
  const elements = new Uint32Array(differences.length);
  let index = 0;
  for (let i = 0; i < differences.length; i++) elements[i] = index += differences[i];
  return elements;
}

// Values become fractions of the range between `low` and `high`.
async function decodeScalar(scalar) {
  const steps = await unpack(scalar.values, Uint16Array);
  return { ...scalar, fractions: Float32Array.from(steps, (step) => step / STEPS) };
}

async function decodeLayer(layer) {
  const [positions, radii, elements, ...scalars] = await Promise.all([
    decodePositions(layer),
    layer.radii && unpack(layer.radii, Float32Array),
    layer.elements && decodeElements(layer.elements),
    ...layer.scalars.map(decodeScalar),
  ]);
  return { ...layer, positions, radii, elements, scalars };
}

/** Return a copy of a scene with typed arrays, its box, and one scale for all layers with the same label. */
export async function decodeScene(scene) {
  const layers = await Promise.all(scene.layers.map(decodeLayer));
  const box = { lower: [Infinity, Infinity, Infinity], upper: [-Infinity, -Infinity, -Infinity] };
  const scales = new Map();
  for (const layer of layers) {
    layer.positions.forEach((place, i) => {
      const reach = layer.radii ? layer.radii[Math.floor(i / 3)] : 0;
      box.lower[i % 3] = Math.min(box.lower[i % 3], place - reach);
      box.upper[i % 3] = Math.max(box.upper[i % 3], place + reach);
    });
    for (const { label, low, high, below, above } of layer.scalars) {
      const scale = scales.get(label) ?? { label, low, high, below, above };
      scale.low = Math.min(scale.low, low);
      scale.high = Math.max(scale.high, high);
      scale.below ||= below;
      scale.above ||= above;
      scales.set(label, scale);
    }
  }
  const diagonal = Math.hypot(...box.upper.map((high, axis) => high - box.lower[axis])) || 1;
  const centre = box.lower.map((low, axis) => (low + box.upper[axis]) / 2);
  return { ...scene, layers, scales, centre, diagonal, ...cylinder(scene.up, layers, centre, box) };
}

// The upright cylinder around the scene: whichever way the scene is turned, it stays inside.
function cylinder(up, layers, centre, box) {
  const [vertical, side] = up === "z" ? [2, 1] : [1, 2];
  let radius = 0;
  for (const { positions, radii } of layers)
    for (let i = 0; i < positions.length; i += 3) {
      const across = Math.hypot(positions[i] - centre[0], positions[i + side] - centre[side]);
      radius = Math.max(radius, across + (radii ? radii[i / 3] : 0));
    }
  return { radius: radius || 0.5, halfHeight: (box.upper[vertical] - box.lower[vertical]) / 2 };
}
