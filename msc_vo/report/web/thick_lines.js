// Line segments of a constant width in pixels, which WebGL itself does not draw: each segment is a
// rectangle that faces the camera.

const THICK_LINE_VERTEX_SHADER = `
  attribute vec3 start, end, color;
  uniform vec2 resolution;
  uniform float width;
  varying vec3 line_color;
  const float near = 0.02;
  void main() {
    vec4 a = modelViewMatrix * vec4(start, 1.0);
    vec4 b = modelViewMatrix * vec4(end, 1.0);
    if (a.z > -near && b.z < -near) a = mix(a, b, (a.z + near) / (a.z - b.z));
    else if (b.z > -near && a.z < -near) b = mix(b, a, (b.z + near) / (b.z - a.z));
    vec4 p = projectionMatrix * a;
    vec4 q = projectionMatrix * b;
    vec2 direction = (q.xy / q.w - p.xy / p.w) * resolution;
    direction = length(direction) > 1e-6 ? normalize(direction) : vec2(1.0, 0.0);
    vec4 corner = position.x < 0.5 ? p : q;
    vec2 normal = vec2(-direction.y, direction.x) * position.y;
    vec2 cap = direction * (position.x < 0.5 ? -0.3 : 0.3);
    corner.xy += (normal + cap) * width / resolution * corner.w;
    gl_Position = corner;
    line_color = color;
  }`;

const THICK_LINE_FRAGMENT_SHADER = `
  uniform float opacity;
  varying vec3 line_color;
  void main() { gl_FragColor = vec4(line_color, opacity); }`;

class ThickLines extends THREE.Mesh {
  // `width`: pixels of the page.
  constructor(width, opacity = 1) {
    const material = new THREE.ShaderMaterial({
      uniforms: {
        resolution: {value: new THREE.Vector2(1, 1)},
        width: {value: width},
        opacity: {value: opacity}
      },
      vertexShader: THICK_LINE_VERTEX_SHADER,
      fragmentShader: THICK_LINE_FRAGMENT_SHADER,
      side: THREE.DoubleSide,
      transparent: opacity < 1,
    });
    super(new THREE.InstancedBufferGeometry(), material);
    this.frustumCulled = false;
    this.setSegments(new Float32Array(0), new Float32Array(0));
  }

  // `ends`: six numbers per segment; `colors`: three numbers per segment.
  setSegments(ends, colors) {
    this.geometry.dispose();
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute(
        "position",
        new THREE.BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const pairs = new THREE.InstancedInterleavedBuffer(ends, 6, 1);
    geometry.setAttribute("start", new THREE.InterleavedBufferAttribute(pairs, 3, 0));
    geometry.setAttribute("end", new THREE.InterleavedBufferAttribute(pairs, 3, 3));
    geometry.setAttribute("color", new THREE.InstancedBufferAttribute(colors, 3));
    geometry.maxInstancedCount = ends.length / 6;
    this.geometry = geometry;
    this.visible = ends.length > 0;
  }

  setResolution(width, height) {
    this.material.uniforms.resolution.value.set(width, height);
  }
}

// The colors of `count` segments that share one color.
function uniformColors(count, color) {
  const colors = new Float32Array(3 * count);
  const rgb = new THREE.Color(color);
  for (let i = 0; i < count; ++i) colors.set([rgb.r, rgb.g, rgb.b], 3 * i);
  return colors;
}

// The segments between consecutive points (three numbers each) that are finite.
function pathSegments(points) {
  const ends = new Float32Array(Math.max(0, 2 * points.length - 6));
  let size = 0;
  for (let i = 0; i + 6 <= points.length; i += 3) {
    const segment = points.subarray(i, i + 6);
    if (!segment.every(Number.isFinite)) continue;
    ends.set(segment, size);
    size += 6;
  }
  return ends.subarray(0, size);
}
