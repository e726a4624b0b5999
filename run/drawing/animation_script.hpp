#pragma once
// Private to the sources of run.
#include <string_view>

namespace abut::run {

/// Script of the page of an animation, between `animation_head` and `animation_body`.
inline constexpr std::string_view animation_script = R"html(<script>
"use strict";
const element = id => document.getElementById(id);

function unpacked(text, Type) {
    const letters = atob(text), bytes = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
    return new Type(bytes.buffer);
}

/// Four significant digits, without an exponent where few zeros do.
const shown = x => x == 0 || Math.abs(x) >= 1e-3 && Math.abs(x) < 1e6 ? String(Number(x.toPrecision(4))) : x.toExponential(3);

const vertex_shader = `#version 300 es
in vec3 position; in float value;
uniform vec3 low, size, offset, middle; uniform mat3 place, view; uniform vec2 scale, shift; uniform float depth, nearer;
out vec3 at; out vec3 seen; flat out float share;
void main() {
    at = place * (low + size * position) + offset;
    seen = view * (at - middle);
    gl_Position = vec4(seen.xy * scale + shift, -seen.z * depth - nearer, 1.0);
    share = value;
}`;
const fragment_shader = `#version 300 es
precision highp float;
in vec3 at; in vec3 seen; flat in float share;
uniform vec3 box_low, box_high; uniform vec4 colour; uniform vec3 colours[9]; uniform float to_end; uniform bool valued, lit, cut;
out vec4 point;
void main() {
    if (cut && (any(lessThan(at, box_low)) || any(greaterThan(at, box_high)))) discard;
    vec4 c = colour;
    if (valued && share <= 65534.0 / 65535.0 + 5e-6) {
        float place = clamp(share * to_end, 0.0, 1.0) * 8.0;
        int stop = int(min(place, 7.0));
        c = vec4(mix(colours[stop], colours[stop + 1], place - float(stop)), 1.0);
    }
    if (lit) {
        vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
        c.rgb *= 0.7 + 0.3 * max(0.0, dot(normal, vec3(-0.35, 0.6, 0.72)));
    }
    point = vec4(c.rgb * c.a, c.a);
}`;

class Film {
    constructor() {
        this.common = JSON.parse(element("common").textContent);
        const n = 2 * (this.common.dim * this.common.n_vertices + this.common.n_polygons);
        const numbers = text => (text ? text.split(" ").map(Number) : []);
        this.frames = [...document.querySelectorAll("script.frame")]
            .filter(f => f.textContent.length == 4 * Math.ceil(n / 3))  // else it was not written to its end
            .map(f => ({time: Number(f.dataset.time), end: Number(f.dataset.end), most: Number(f.dataset.most),
                        low: numbers(f.dataset.low), size: numbers(f.dataset.size), places: numbers(f.dataset.places),
                        text: f}));
        this.end = Math.max(this.common.least_end, ...this.frames.map(f => f.end)) || 1;
        this.topology();
        this.extent();
    }
    /// Triangles of polygons, their edges, and vertices of bodies.
    topology() {
        const c = this.common, counts = unpacked(c.counts, Uint32Array), corners = unpacked(c.corners, Uint32Array);
        const kinds = unpacked(c.edges, Uint8Array), body = unpacked(c.body, Int32Array);
        const triangles = [], polygons = [], edges = [[], [], [], []];
        this.of_body = c.bodies.map(() => new Set());
        for (let i = 0, begin = 0; i < counts.length; begin += counts[i++])
            for (let k = 0; k < counts[i]; ++k) {
                const from = corners[begin + k], to = corners[begin + (k + 1) % counts[i]];
                this.of_body[body[i]].add(from);
                edges[kinds[begin + k]].push(from, to);
                if (k == 0 || k + 1 == counts[i]) continue;
                triangles.push(corners[begin], from, to);
                polygons.push(i);
            }
        this.of_body = this.of_body.map(vertices => [...vertices]);
        this.triangles = Uint32Array.from(triangles);
        this.polygons = Uint32Array.from(polygons);
        this.edges = edges.map(ends => Uint32Array.from(ends));
        this.obstacles = c.obstacles.map(o => unpacked(o.corners, Float32Array));
    }
    /// Triangles of an obstacle: in 2D of strips behind its segments, whose outside is on their right.
    faces(corners) {
        if (this.common.dim == 3) return corners;
        const faces = [];
        for (let i = 0; i < corners.length; i += 6) {
            const [ax, ay, , bx, by] = corners.subarray(i, i + 6), thick = 0.012 * this.size / (Math.hypot(bx - ax, by - ay) || 1);
            const x = thick * (ay - by), y = thick * (bx - ax);
            faces.push(ax, ay, 0, bx, by, 0, bx + x, by + y, 0, ax, ay, 0, bx + x, by + y, 0, ax + x, ay + y, 0);
        }
        return Float32Array.from(faces);
    }
    /// The box of all bodies at all times, and of obstacles that are not larger.
    extent() {
        const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
        const add = (x, to_low = low, to_high = high) => x.forEach((v, i) => {
            to_low[i] = Math.min(to_low[i], v);
            to_high[i] = Math.max(to_high[i], v);
        });
        for (const f of this.frames) add(f.low), add(f.low.map((v, i) => v + f.size[i]));
        const largest = (l, h) => Math.max(...h.map((v, i) => v - l[i])), size = largest(low, high);
        this.obstacles.forEach((corners, o) => {
            const l = [Infinity, Infinity, Infinity], h = [-Infinity, -Infinity, -Infinity];
            for (let i = 0; i < corners.length; i += 3) add([...corners.slice(i, i + 3)], l, h);
            if (largest(l, h) > size) return;
            for (const f of this.frames)
                for (let k = 0; k < 8; ++k) add(this.placed(f, o, l.map((v, i) => (k >> i & 1 ? h[i] : v))));
        });
        const more = 0.06 * (largest(low, high) || 1);
        this.low = low.map(v => v - more);
        this.high = high.map(v => v + more);
        this.middle = low.map((v, i) => (v + high[i]) / 2);
        this.size = Math.hypot(...this.high.map((v, i) => v - this.low[i]));
    }
    placed(frame, obstacle, x) {
        const p = frame.places.slice(12 * obstacle, 12 * obstacle + 12);
        return [0, 1, 2].map(i => p[3 * i] * x[0] + p[3 * i + 1] * x[1] + p[3 * i + 2] * x[2] + p[9 + i]);
    }
    /// Positions by vertex and values by polygon, both of 0 to 65535.
    numbers(i) {
        const c = this.common, all = unpacked(this.frames[i].text.textContent, Uint16Array);
        const position = new Uint16Array(3 * c.n_vertices);
        for (let v = 0; v < c.n_vertices; ++v)
            for (let k = 0; k < c.dim; ++k) position[3 * v + k] = all[c.dim * v + k];
        return {position, value: all.subarray(c.dim * c.n_vertices)};
    }
}

class Viewer {
    constructor(film) {
        this.film = film;
        this.flat = film.common.dim == 2;
        this.canvas = element("canvas");
        this.gl = this.canvas.getContext("webgl2", {antialias: true});
        if (!this.gl) throw Error("This browser has no WebGL 2, which the animation is drawn with.");
        this.names = film.common.bodies.map(text => {
            const name = element("stage").appendChild(document.createElement("span"));
            name.className = "name";
            name.textContent = text;
            return name;
        });
        this.prepare();
        this.listen();
        this.reset();
        this.show(Math.min(Math.max(0, Number(location.hash.slice(1)) || 0), film.frames.length - 1));
    }
    prepare() {
        const gl = this.gl, program = gl.createProgram(), film = this.film;
        for (const [kind, text] of [[gl.VERTEX_SHADER, vertex_shader], [gl.FRAGMENT_SHADER, fragment_shader]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw Error(gl.getShaderInfoLog(shader));
            gl.attachShader(program, shader);
        }
        gl.bindAttribLocation(program, 0, "position");
        gl.bindAttribLocation(program, 1, "value");
        gl.linkProgram(program);
        gl.useProgram(program);
        this.at = new Proxy({}, {get: (known, name) => known[name] ??= gl.getUniformLocation(program, name)});
        this.buffer = {position: gl.createBuffer(), value: gl.createBuffer(), vertex: gl.createBuffer()};
        const filled = (numbers, kind) => {
            const buffer = gl.createBuffer();
            gl.bindBuffer(kind, buffer);
            gl.bufferData(kind, numbers, gl.STATIC_DRAW);
            return buffer;
        };
        this.edges = film.edges.map(ends => filled(ends, gl.ELEMENT_ARRAY_BUFFER));
        this.faces = film.obstacles.map(corners => film.faces(corners));
        this.solid = this.faces.map(faces => filled(faces, gl.ARRAY_BUFFER));
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    }
    reset() {
        [this.turn, this.rise, this.zoom, this.move] = [0.45, 0.42, 1, [0, 0]];
    }
    /// To the right, upwards and to the eye, by rows.
    view() {
        if (this.flat) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        const c = Math.cos(this.turn), s = Math.sin(this.turn), level = Math.cos(this.rise), up = Math.sin(this.rise);
        return [[c, s, 0], [-s * up, c * up, level], [s * level, -c * level, up]];
    }
    /// Pixels of the page per metre.
    pixels() {
        const {low, high, middle} = this.film, view = this.view(), most = [0, 0];
        for (let k = 0; k < 8; ++k)
            for (const i of [0, 1]) {
                const corner = low.map((v, j) => (k >> j & 1 ? high[j] : v) - middle[j]);
                most[i] = Math.max(most[i], Math.abs(view[i][0] * corner[0] + view[i][1] * corner[1] + view[i][2] * corner[2]));
            }
        return this.zoom * Math.min(this.canvas.clientWidth / (2 * most[0]), this.canvas.clientHeight / (2 * most[1]));
    }
    show(i) {
        const film = this.film, gl = this.gl;
        this.now = i;
        this.numbers = film.numbers(i);
        const {position, value} = this.numbers, n = film.triangles.length;
        const corners = new Uint16Array(3 * n), values = new Uint16Array(n);
        for (let k = 0; k < n; ++k) {
            for (let j = 0; j < 3; ++j) corners[3 * k + j] = position[3 * film.triangles[k] + j];
            values[k] = value[film.polygons[Math.floor(k / 3)]];
        }
        for (const [name, numbers] of [["position", corners], ["value", values], ["vertex", position]]) {
            gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer[name]);
            gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
        }
        const frame = film.frames[i], {value: name, unit, least_end} = film.common;
        element("slider").value = i;
        element("time").textContent = `t = ${shown(frame.time)} s, ${name} up to ${shown(frame.most < least_end ? 0 : frame.most)} ${unit}`;
        this.draw();
    }
    attribute(place, buffer, size, kind) {
        const gl = this.gl;
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, size, kind, kind == gl.UNSIGNED_SHORT, 0, 0);
    }
    draw() {
        const gl = this.gl, film = this.film, frame = film.frames[this.now], canvas = this.canvas, at = this.at;
        const dense = window.devicePixelRatio || 1, wide = canvas.clientWidth, high = canvas.clientHeight;
        canvas.width = Math.max(1, Math.round(dense * wide));
        canvas.height = Math.max(1, Math.round(dense * high));
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        const pixels = this.pixels(), view = this.view();
        gl.uniform3fv(at.middle, film.middle);
        gl.uniformMatrix3fv(at.view, true, view.flat());
        gl.uniform2f(at.scale, 2 * pixels / wide, 2 * pixels / high);
        const shift = (x, y) => gl.uniform2f(at.shift, 2 * (this.move[0] + x) / wide, -2 * (this.move[1] + y) / high);
        shift(0, 0);
        gl.uniform1f(at.depth, 1 / film.size);
        gl.uniform3fv(at.box_low, film.low);
        gl.uniform3fv(at.box_high, film.high);
        gl.uniform3fv(at.colours, film.common.colours.flat().map(c => c / 255));
        gl.uniform1f(at.to_end, frame.most / film.end * 65535 / 65534);
        const put = (low, size, place) => {
            gl.uniform3fv(at.low, low);
            gl.uniform3fv(at.size, size);
            gl.uniformMatrix3fv(at.place, true, place.slice(0, 9));
            gl.uniform3fv(at.offset, place.slice(9));
        };
        const style = (colour, valued, lit, cut, nearer) => {
            gl.uniform4fv(at.colour, colour);
            gl.uniform1i(at.valued, valued);
            gl.uniform1i(at.lit, lit);
            gl.uniform1i(at.cut, cut);
            gl.uniform1f(at.nearer, nearer);
        };
        put(frame.low, frame.size, [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
        style([0.59, 0.59, 0.57, 1], true, !this.flat, false, 0);
        this.attribute(0, this.buffer.position, 3, gl.UNSIGNED_SHORT);
        this.attribute(1, this.buffer.value, 1, gl.UNSIGNED_SHORT);
        gl.drawArrays(gl.TRIANGLES, 0, film.triangles.length);
        gl.disableVertexAttribArray(1);
        this.attribute(0, this.buffer.vertex, 3, gl.UNSIGNED_SHORT);
        // between cells, of the boundary, held, loaded
        [[0, 0, 0, 0.3], [0, 0, 0, 0.8], [0.85, 0.35, 0.12, 1], [0.86, 0.15, 0.5, 1]].forEach((colour, kind) => {
            if (!film.edges[kind].length || kind == 0 && !element("cells").checked) return;
            style(colour, false, false, false, 1e-4 * (1 + kind));
            gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.edges[kind]);
            for (const [x, y] of kind < 2 ? [[0, 0]] : [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]]) {  // as thick as that
                shift(x, y);
                gl.drawElements(gl.LINES, film.edges[kind].length, gl.UNSIGNED_INT, 0);
            }
        });
        shift(0, 0);
        gl.enable(gl.CULL_FACE);  // obstacles are seen from their outside alone
        this.faces.forEach((faces, o) => {
            put([0, 0, 0], [1, 1, 1], frame.places.slice(12 * o, 12 * o + 12));
            style([0.5, 0.5, 0.48, this.flat ? 0.8 : 0.45], false, !this.flat, true, this.flat ? -1e-4 : 0);
            this.attribute(0, this.solid[o], 3, gl.FLOAT);
            gl.drawArrays(gl.TRIANGLES, 0, faces.length / 3);
        });
        gl.disable(gl.CULL_FACE);
        this.label(pixels, view);
    }
    /// Names of bodies, directions and a length.
    label(pixels, view) {
        const film = this.film, frame = film.frames[this.now], {position} = this.numbers;
        const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        this.names.forEach((name, b) => {
            name.hidden = !element("names").checked;
            if (name.hidden) return;
            const mean = [0, 0, 0], vertices = film.of_body[b];
            for (const v of vertices) for (let i = 0; i < 3; ++i) mean[i] += position[3 * v + i] / (65535 * vertices.length);
            const x = mean.map((m, i) => frame.low[i] + m * frame.size[i] - film.middle[i]);
            name.style.left = `${this.canvas.clientWidth / 2 + pixels * dot(view[0], x) + this.move[0]}px`;
            name.style.top = `${this.canvas.clientHeight / 2 - pixels * dot(view[1], x) + this.move[1]}px`;
        });
        const length = 0.25 * this.canvas.clientWidth / pixels, power = 10 ** Math.floor(Math.log10(length));
        const round = power * (length >= 5 * power ? 5 : length >= 2 * power ? 2 : 1);
        element("length").style.width = `${round * pixels}px`;
        element("length").textContent = `${shown(round)} m`;
        const axes = this.flat ? ["x", "y"] : ["x", "y", "z"];
        element("axes").innerHTML = axes.map((name, i) => {
            const x = view[0][i], y = -view[1][i];
            return `<line x1="34" y1="34" x2="${34 + 22 * x}" y2="${34 + 22 * y}"/>` +
                   `<text x="${34 + 29 * x}" y="${38 + 29 * y}">${name}</text>`;
        }).join("");
    }
    listen() {
        const canvas = this.canvas, touches = new Map();
        canvas.onpointerdown = e => {
            canvas.setPointerCapture(e.pointerId);
            touches.set(e.pointerId, [e.clientX, e.clientY]);
        };
        canvas.onpointerup = canvas.onpointercancel = e => touches.delete(e.pointerId);
        canvas.onpointermove = e => {
            const before = touches.get(e.pointerId);
            if (!before) return;
            const apart = () => {
                const [a, b] = [...touches.values()];
                return Math.hypot(a[0] - b[0], a[1] - b[1]) || 1;
            };
            const [x, y] = [e.clientX - before[0], e.clientY - before[1]], two = touches.size == 2, distance = two && apart();
            touches.set(e.pointerId, [e.clientX, e.clientY]);
            if (two) this.zoom *= apart() / distance;
            if (two || this.flat || e.shiftKey || e.buttons > 1) {
                const share = two ? 0.5 : 1;
                this.move = [this.move[0] + share * x, this.move[1] + share * y];
            } else {
                this.turn -= 0.01 * x;
                this.rise = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.rise + 0.01 * y));
            }
            this.draw();
        };
        canvas.onwheel = e => {
            e.preventDefault();
            const by = Math.exp(-0.0015 * e.deltaY), box = canvas.getBoundingClientRect();
            const from_middle = [e.clientX - box.left - box.width / 2, e.clientY - box.top - box.height / 2];
            this.move = this.move.map((m, i) => from_middle[i] + by * (m - from_middle[i]));
            this.zoom *= by;
            this.draw();
        };
        canvas.ondblclick = () => (this.reset(), this.draw());
        canvas.oncontextmenu = e => e.preventDefault();
        canvas.addEventListener("webglcontextlost", e => e.preventDefault());
        canvas.addEventListener("webglcontextrestored", () => (this.prepare(), this.show(this.now)));
        new ResizeObserver(() => this.draw()).observe(element("stage"));
        for (const box of ["cells", "names"]) element(box).onchange = () => this.draw();
        const last = this.film.frames.length - 1, slider = element("slider");
        slider.max = last;
        slider.oninput = () => (this.stop(), this.show(Number(slider.value)));
        element("play").onclick = () => (this.playing ? this.stop() : this.play());
        document.onkeydown = e => {
            if (e.target.tagName == "SELECT") return;
            if (e.key == " ") e.preventDefault(), element("play").onclick();
            const step = {ArrowLeft: -1, ArrowRight: 1}[e.key];
            if (step) e.preventDefault(), this.stop(), this.show(Math.max(0, Math.min(last, this.now + step)));
        };
    }
    play() {
        const last = this.film.frames.length - 1;
        let before = performance.now(), frame = this.now == last ? 0 : this.now;
        const next = () => {
            if (!this.playing) return;
            const now = performance.now();
            frame = Math.min(last, frame + (now - before) / 1000 * last / Number(element("seconds").value));
            before = now;
            if (Math.floor(frame) != this.now) this.show(Math.floor(frame));
            if (this.now == last) this.stop();
            else setTimeout(next, 15);
        };
        this.playing = true;
        element("play").textContent = "Pause";
        next();
    }
    stop() {
        this.playing = false;
        element("play").textContent = "Play";
    }
}

document.addEventListener("DOMContentLoaded", () => {
    try {
        const film = new Film(), {title, comment, note, bodies, colours, value, unit} = film.common;
        element("title").textContent = title;
        element("comment").textContent = [comment, note].filter(text => text).join("\n");
        element("comment").hidden = !comment && !note;
        element("names").checked = bodies.length > 1 && bodies.length < 9;
        element("cells").checked = film.polygons.length < 5000;
        element("bar").style.background = `linear-gradient(to right, ${colours.map(c => `rgb(${c})`).join(", ")})`;
        element("end").textContent = `${shown(film.end)} ${unit}: ${value}`;
        element("marks").textContent = [film.edges[2].length ? "orange edges: held" : "",
                                        film.edges[3].length ? "pink edges: under a traction" : ""].filter(t => t).join("; ");
        element("hint").textContent = (film.common.dim == 2 ? "drag: move" : "drag: turn; shift and drag: move") +
                                      "; wheel: zoom; double click: as at first; space: play; arrows: a frame";
        if (!film.frames.length) throw Error("There is no frame in this file.");
        window.viewer = new Viewer(film);
    } catch (error) {
        element("comment").hidden = false;
        element("comment").textContent = error.message;
    }
});
</script>
)html";

}  // namespace abut::run
