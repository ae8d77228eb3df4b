// Shaders for what three.js has no material for.

export const POINT_VERTEX = `
attribute vec3 color;
uniform float radius, pixels;
varying vec3 tint;
void main() {
  tint = color;
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * place;
  gl_PointSize = clamp(2.0 * radius * pixels / -place.z, 2.0, 64.0);
}`;

// A disc, darker towards its edge, so that dots that overlap can be told apart.
export const POINT_FRAGMENT = `
varying vec3 tint;
void main() {
  float edge = length(2.0 * gl_PointCoord - 1.0);
  if (edge > 1.0) discard;
  gl_FragColor = vec4(tint * (1.0 - 0.45 * edge * edge), 1.0);
  #include <colorspace_fragment>
}`;

export const SURFACE_VERTEX = `
attribute vec3 color;
varying vec3 tint, direction, towards;
void main() {
  tint = color;
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  direction = normalMatrix * normal;
  towards = -place.xyz;
  gl_Position = projectionMatrix * place;
}`;

// A veil is densest at its outline; the more opaque it is, the more it is shaded like a solid.
export const SURFACE_FRAGMENT = `
uniform float opacity;
varying vec3 tint, direction, towards;
void main() {
  vec3 normal = normalize(direction);
  float facing = abs(dot(normal, normalize(towards)));
  if (dot(normal, towards) < 0.0) normal = -normal;
  float light = 0.4 + 0.6 * max(0.0, dot(normal, normalize(vec3(-0.35, 0.65, 0.68))));
  float dense = mix(opacity, min(1.0, opacity + 0.55), pow(1.0 - facing, 3.0));
  gl_FragColor = vec4(tint * mix(1.0, light, opacity), dense);
  #include <colorspace_fragment>
}`;
