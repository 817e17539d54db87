// The three programs. A palette of 256 texels a row holds the color of each class (alpha: shown), which
// classes are context, and the colors of the map.
const common = `
uniform mat4 camera; uniform sampler2D palette; uniform int base; uniform vec4 plane; uniform bool mapped;
vec4 entry(int row, int at) { return texelFetch(palette, ivec2(at, row), 0); }`;
const names = `
vec4 name(int n) { return vec4(n & 255, n >> 8 & 255, n >> 16 & 255, n >> 24 & 255) / 255.0; }`;
const fragment = `
uniform vec4 plane; uniform bool picking; out vec4 pixel;${names}`;
const mapColor = `
uniform sampler2D palette; uniform bool mapped; uniform vec2 band; uniform vec3 inBand;
vec3 colored(vec3 plain, float value) {
    if (!mapped || value < -500.0) return plain;  // there is none
    if (value >= band.x && value <= band.y) return inBand;
    return texelFetch(palette, ivec2(int(clamp(value, 0.0, 1.0) * 255.0 + 0.5), 2), 0).rgb;
}`;

export const faceShaders = [`
in vec3 position; in float kind; in float value; uniform vec3 eye;${common}
out vec3 place; out vec3 ray; out float at; out vec3 corner; flat out vec3 color; flat out int id; flat out int context;
void main() {
    vec4 own = entry(0, int(kind));
    gl_Position = own.a > 0.5 ? camera * vec4(position, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
    place = position; ray = position - eye; at = value; color = own.rgb; id = base + gl_VertexID / 3;
    context = entry(1, int(kind)).r > 0.5 ? 1 : 0;
    int c = gl_VertexID % 3;
    corner = vec3(c == 0, c == 1, c == 2);
}`, `
in vec3 place; in vec3 ray; in float at; in vec3 corner; flat in vec3 color; flat in int id; flat in int context;
uniform bool through; uniform bool glass; uniform bool edges; uniform float alpha; uniform bool cut;${fragment}${mapColor}
void main() {
    if (dot(plane.xyz, place) > plane.w) discard;
    bool sieve = int(gl_FragCoord.x) % 3 != 0 || int(gl_FragCoord.y) % 3 != 0;
    if (context == 1 && (through || glass && (picking || sieve))) discard;
    if (picking) { pixel = name(id); return; }
    if (through) { pixel = vec4(color, 0.3); return; }
    vec3 normal = normalize(cross(dFdx(ray), dFdy(ray)));
    float light = 0.45 + 0.55 * abs(dot(normal, normalize(ray)));
    vec3 own = context == 1 ? colored(color, at) : color;  // findings keep their colors
    if (!gl_FrontFacing) light = cut ? 0.55 : 0.72 * light;
    vec3 wide = fwidth(corner);
    vec3 near = smoothstep(vec3(0.0), 1.2 * wide, corner);
    if (edges) light *= 0.45 + 0.55 * min(min(near.x, near.y), near.z);
    pixel = vec4(own * light, alpha);
}`];

export const lineShaders = [`
in vec2 corner; in vec3 from; in vec3 to; uniform vec2 size; uniform float width; uniform int kind;${common}
out vec3 place; flat out vec3 color; flat out int id;
void main() {
    vec4 own = entry(0, kind);
    vec4 p = camera * vec4(from, 1.0), q = camera * vec4(to, 1.0);
    float least = 1e-5;
    id = base + gl_InstanceID; color = own.rgb; place = mix(from, to, corner.x);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    if (own.a < 0.5 || p.w < least && q.w < least) return;
    if (p.w < least) p = mix(q, p, (q.w - least) / (q.w - p.w));
    if (q.w < least) q = mix(p, q, (p.w - least) / (p.w - q.w));
    vec2 way = (q.xy / q.w - p.xy / p.w) * size;
    way = dot(way, way) > 0.0 ? normalize(way) : vec2(1.0, 0.0);
    vec4 end = corner.x < 0.5 ? p : q;
    vec2 off = vec2(-way.y, way.x) * corner.y + way * (corner.x * 2.0 - 1.0) * 0.5;
    end.xy += off * width / size * end.w;
    end.z -= 0.0004 * end.w;
    gl_Position = end;
}`, `
in vec3 place; flat in vec3 color; flat in int id; uniform float alpha;${fragment}
void main() {
    if (dot(plane.xyz, place) > plane.w) discard;
    pixel = picking ? name(id) : vec4(color, alpha);
}`];

export const dotShaders = [`
in vec3 position; in float kind; in float value; uniform float width;${common}
out vec3 place; out float at; flat out vec3 color; flat out int id; flat out int context;
void main() {
    context = entry(1, int(kind)).r > 0.5 ? 1 : 0;
    vec4 own = entry(0, int(kind));
    gl_Position = own.a > 0.5 ? camera * vec4(position, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
    gl_Position.z -= 0.002 * gl_Position.w;
    gl_PointSize = width; place = position; at = value; color = own.rgb; id = base + gl_VertexID;
}`, `
in vec3 place; in float at; flat in vec3 color; flat in int id; flat in int context;
uniform bool through; uniform float alpha;${fragment}${mapColor}
void main() {
    vec2 off = 2.0 * gl_PointCoord - 1.0;
    if (through && context == 1) discard;
    if (dot(off, off) > 1.0 || dot(plane.xyz, place) > plane.w) discard;
    pixel = picking ? name(id) : vec4(colored(color, at) * (1.0 - 0.35 * dot(off, off)), alpha);
}`];
