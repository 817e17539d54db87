// Draws the scene with WebGL 2, and says what is at a pixel.
import { noValue } from './data.js';
import { faceShaders, lineShaders, dotShaders } from './shaders.js';

const places = ['position', 'kind', 'value', 'corner', 'from', 'to'];

const makeProgram = (gl, shaders) => {
    const made = gl.createProgram();
    [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((type, i) => {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, '#version 300 es\nprecision highp float;precision highp int;' + shaders[i]);
        gl.compileShader(shader);
        gl.attachShader(made, shader);
    });
    places.forEach((name, i) => gl.bindAttribLocation(made, i, name));
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    const uniforms = {};
    for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); ++i) {
        const { name, type } = gl.getActiveUniform(made, i);
        uniforms[name] = { type, where: gl.getUniformLocation(made, name) };
    }
    const vectors = { [gl.FLOAT_VEC2]: 'uniform2fv', [gl.FLOAT_VEC3]: 'uniform3fv', [gl.FLOAT_VEC4]: 'uniform4fv' };
    /// Sets the uniforms that the program has.
    const set = (values) => {
        gl.useProgram(made);
        for (const [name, value] of Object.entries(values)) {
            const uniform = uniforms[name];
            if (!uniform) continue;
            if (uniform.type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(uniform.where, false, value);
            else if (uniform.type in vectors) gl[vectors[uniform.type]](uniform.where, value);
            else if (uniform.type === gl.FLOAT) gl.uniform1f(uniform.where, value);
            else gl.uniform1i(uniform.where, Number(value));
        }
    };
    return { set };
};

export class Renderer {
    constructor(canvas, scene) {
        this.canvas = canvas;
        this.scene = scene;
        const gl = this.gl = canvas.getContext('webgl2', { antialias: true, alpha: true });
        if (!gl) return;
        [this.faces, this.lines, this.dots] = [faceShaders, lineShaders, dotShaders].map((s) => makeProgram(gl, s));
        gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
        this.quad = this.buffer(new Float32Array([0, -1, 1, -1, 1, 1, 0, -1, 1, 1, 0, 1]));
        let base = 1;  // 0 is nothing
        const numbered = (item, count) => Object.assign(item, { base, named: count }) && (base += count);
        for (const mesh of scene.meshes) {
            mesh.array = this.array([[0, mesh.positions, 3], [1, mesh.kinds, 1], [2, mesh.values, 1]]);
            numbered(mesh, mesh.faces);
        }
        for (const lines of scene.lines) {
            lines.array = this.lineArray(lines.positions);
            numbered(lines, lines.count);
        }
        for (const dots of scene.dots) {
            dots.array = this.array([[0, dots.positions, 3], [1, dots.kinds, 1], [2, dots.values, 1]]);
            numbered(dots, dots.count);
        }
        this.palette = gl.createTexture();
        this.outline = null;  // of the face that was picked
        gl.bindTexture(gl.TEXTURE_2D, this.palette);
        for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
            gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    }

    buffer(data) {
        const { gl } = this, made = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, made);
        gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
        return made;
    }

    array(attributes) {
        const { gl } = this, made = gl.createVertexArray();
        gl.bindVertexArray(made);
        for (const [place, data, size] of attributes) {
            if (!data) continue;
            this.buffer(data);
            gl.enableVertexAttribArray(place);
            gl.vertexAttribPointer(place, size, data instanceof Uint8Array ? gl.UNSIGNED_BYTE : gl.FLOAT, false, 0, 0);
        }
        return made;
    }

    lineArray(positions) {
        const { gl } = this, made = this.array([[4, positions, 3]]);
        for (const [place, from] of [[4, 0], [5, 12]]) {
            gl.enableVertexAttribArray(place);
            gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 24, from);
            gl.vertexAttribDivisor(place, 1);
        }
        gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
        gl.enableVertexAttribArray(3);
        gl.vertexAttribPointer(3, 2, gl.FLOAT, false, 0, 0);
        return made;
    }

    paint(classes, ramp) {
        const { gl } = this, texels = new Uint8Array(4 * 256 * 3);
        classes.forEach((c, i) => {
            texels.set([...c.rgb, c.shown ? 255 : 0], 4 * i);
            texels[4 * (256 + i)] = c.context ? 255 : 0;
        });
        ramp.forEach((rgb, i) => texels.set([...rgb, 255], 4 * (512 + i)));
        gl.bindTexture(gl.TEXTURE_2D, this.palette);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 3, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
    }

    resize() {
        const { canvas } = this, scale = window.devicePixelRatio || 1;
        const size = [canvas.clientWidth, canvas.clientHeight].map((s) => Math.max(1, Math.round(s * scale)));
        if (canvas.width !== size[0]) canvas.width = size[0];
        if (canvas.height !== size[1]) canvas.height = size[1];
        return scale;
    }

    /// `panes`: parts of the picture, each with what it shows; `look`: switches and the plane.
    draw(panes, look) {
        const { gl, canvas } = this;
        this.resize();
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.SCISSOR_TEST);
        for (const pane of panes) {
            const at = (share) => Math.round(share * canvas.width);
            gl.viewport(at(pane.left), 0, at(pane.left + pane.width) - at(pane.left), canvas.height);
            gl.scissor(at(pane.from), 0, at(pane.to) - at(pane.from), canvas.height);
            this.drawPane(pane, look, false);
        }
        gl.disable(gl.SCISSOR_TEST);
    }

    drawPane(pane, look, picking) {
        const { gl, canvas, scene } = this;
        const width = pane.width * canvas.width;
        const common = { ...look, picking, camera: pane.camera, eye: pane.eye, size: [width, canvas.height], palette: 0,
            through: false, alpha: 1 };
        const shown = (item) => !item.variant || item.variant === pane.variant;
        const scale = window.devicePixelRatio || 1;
        gl.bindTexture(gl.TEXTURE_2D, this.palette);
        gl.enable(gl.DEPTH_TEST);
        const faces = (ghosts) => {
            for (const mesh of scene.meshes) {
                if (!shown(mesh) || Boolean(mesh.ghost) !== ghosts) continue;
                this.faces.set({ base: mesh.base });
                gl.bindVertexArray(mesh.array);
                if (!mesh.values) gl.vertexAttrib1f(2, noValue);
                gl.drawArrays(gl.TRIANGLES, 0, 3 * mesh.faces);
            }
        };
        this.faces.set(common);
        faces(false);
        this.drawDots(common, shown, scale, picking);
        this.drawLines(common, shown, scale, picking);
        if (picking) return;
        gl.enable(gl.BLEND);
        gl.depthMask(false);
        this.faces.set({ alpha: 0.22, mapped: false });
        faces(true);
        gl.depthFunc(gl.GREATER);  // what was found shines through what hides it
        this.faces.set({ through: true });
        faces(false);
        this.drawDots({ ...common, through: true, alpha: 0.35 }, shown, scale, false);
        gl.depthFunc(gl.LESS);
        gl.depthMask(true);
        gl.disable(gl.BLEND);
    }

    drawDots(common, shown, scale, picking) {
        const { gl, scene } = this;
        this.dots.set({ ...common });
        for (const dots of scene.dots.filter(shown)) {
            this.dots.set({ base: dots.base, width: scale * (dots.width * (dots.count < 3000 ? 1.6 : 1) + (picking ? 6 : 0)) });
            gl.bindVertexArray(dots.array);
            if (!dots.values) gl.vertexAttrib1f(2, noValue);
            gl.drawArrays(gl.POINTS, 0, dots.count);
        }
    }

    drawLines(common, shown, scale, picking) {
        const { gl, scene, outline } = this;
        this.lines.set(common);
        const all = [...scene.lines.filter((l) => shown(l) && (!picking || l.numbers)), ...picking || !outline ? [] : [outline]];
        for (const hidden of picking ? [false] : [true, false]) {  // faintly through faces, fully in front
            gl[hidden ? 'enable' : 'disable'](gl.BLEND);
            gl.depthMask(!hidden);
            gl.depthFunc(hidden ? gl.GREATER : gl.LESS);
            for (const lines of all) {
                this.lines.set({ base: lines.base, kind: lines.class, alpha: hidden ? 0.3 : 1,
                    width: scale * (lines.width + (picking ? 8 : 0)) });
                gl.bindVertexArray(lines.array);
                gl.drawArraysInstanced(gl.TRIANGLES, 0, 6, lines.count);
            }
        }
        gl.depthMask(true);
        gl.depthFunc(gl.LESS);
        gl.disable(gl.BLEND);
    }

    /// The item and its row at a pixel of the picture, from the upper left.
    pick(pane, look, x, y) {
        const { gl, canvas, scene } = this;
        const [w, h] = [canvas.width, canvas.height];
        const target = gl.createFramebuffer(), color = gl.createRenderbuffer(), depth = gl.createRenderbuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, target);
        for (const [made, format, place] of [[color, gl.RGBA8, gl.COLOR_ATTACHMENT0],
            [depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
            gl.bindRenderbuffer(gl.RENDERBUFFER, made);
            gl.renderbufferStorage(gl.RENDERBUFFER, format, w, h);
            gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, made);
        }
        const at = [Math.min(Math.floor(x), w - 1), Math.max(0, h - 1 - Math.floor(y))];
        gl.viewport(Math.round(pane.left * w), 0, Math.round(pane.width * w), h);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(...at, 1, 1);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        this.drawPane(pane, look, true);
        const p = new Uint8Array(4);
        gl.readPixels(...at, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, p);
        gl.disable(gl.SCISSOR_TEST);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.deleteFramebuffer(target);
        gl.deleteRenderbuffer(color);
        gl.deleteRenderbuffer(depth);
        const name = p[0] + 256 * p[1] + 65536 * p[2] + 16777216 * p[3];
        for (const [sort, items] of Object.entries({ face: scene.meshes, line: scene.lines, dot: scene.dots }))
            for (const item of items)
                if (name >= item.base && name < item.base + item.named) return { sort, item, row: name - item.base };
        return null;
    }

    showOutline(corners) {
        const { gl } = this;
        if (this.outline) gl.deleteVertexArray(this.outline.array);
        const ends = corners && [0, 1, 2].flatMap((i) => [...corners[i], ...corners[(i + 1) % 3]]);
        this.outline = corners && { array: this.lineArray(new Float32Array(ends)), count: 3, width: 3, class: 255, base: 0 };
    }

    /// The pixels of a picture just drawn: RGBA, from the lower left.
    pixels() {
        const { gl, canvas } = this, data = new Uint8Array(4 * canvas.width * canvas.height);
        gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, data);
        return data;
    }
}
