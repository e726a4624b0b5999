"""check_animation.py BROWSER ABUT SCENE...: runs scenes into animations and looks at them in a headless browser without network.
Bodies have to be drawn in every frame that the slider is moved to, and differently in the last one than in the first; in 3D
they turn as the mouse is dragged; play goes on by itself; nothing is asked for and nothing fails. A file that was cut off
shows the frames that are whole."""
import json
import pathlib
import subprocess
import sys
import tempfile

from check_report import Answer

MEASURE = """<!DOCTYPE html><html><body style="margin:0">
<iframe id="page" src="animation.html" style="border:0;width:900px;height:700px"></iframe><pre id="answer"></pre><script>
document.getElementById("page").onload = async function () {
    const page = this.contentWindow, of = id => page.document.getElementById(id), answer = {};
    const image = () => {  // drawn in this task, so that the buffer is still there
        const gl = of("canvas").getContext("webgl2"), [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
        const points = new Uint8Array(4 * w * h);
        gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, points);
        answer.gl = Math.max(answer.gl || 0, gl.getError());
        return points;
    };
    const drawn = points => points.filter((_, i) => i % 4 == 3 && points[i] == 255).length;
    const differ = (a, b) => a.filter((v, i) => v != b[i]).length / a.length;
    const move = to => {
        of("slider").value = to;
        of("slider").dispatchEvent(new page.Event("input"));
        return image();
    };
    const mouse = (kind, x, y) => of("canvas").dispatchEvent(
        new page.PointerEvent(kind, {clientX: x, clientY: y, pointerId: 1, buttons: 1, bubbles: true}));
    answer.frames = Number(of("slider").max) + 1;
    const images = [...Array(answer.frames).keys()].map(move);
    answer.drawn = images.map(drawn);
    answer.points = images[0].length / 4;
    answer.moves = differ(images[0], images.at(-1));
    answer.again = differ(images[0], move(0));
    answer.time = of("time").textContent;
    of("canvas").setPointerCapture = () => {};  // there is no such pointer
    mouse("pointerdown", 400, 300);
    mouse("pointermove", 480, 330);
    answer.dragged = differ(images[0], image());
    mouse("pointerup", 480, 330);
    of("canvas").dispatchEvent(new page.WheelEvent("wheel", {deltaY: -800, clientX: 450, clientY: 300, cancelable: true}));
    answer.zoomed = drawn(image());
    of("canvas").dispatchEvent(new page.MouseEvent("dblclick"));
    answer.reset = differ(images[0], image());
    of("seconds").value = "4";
    of("play").click();
    for (let i = 0; i < 2000 && of("play").textContent != "Play"; ++i) await new Promise(go => setTimeout(go, 20));
    answer.played_to = Number(of("slider").value);
    answer.title = page.document.title;
    answer.text = of("comment").textContent;
    document.getElementById("answer").textContent = JSON.stringify(answer);
};
</script></body></html>
"""


def look(browser, folder):
    """What the animation of a folder shows, and what the browser complains of."""
    page = pathlib.Path(folder, "measure.html")
    page.write_text(MEASURE)
    with tempfile.TemporaryDirectory() as profile:
        ran = subprocess.run(
            [browser, "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--user-data-dir=" + profile,
             "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--host-resolver-rules=MAP * ~NOTFOUND",
             "--allow-file-access-from-files", "--enable-logging=stderr", "--window-size=1000,900",
             "--virtual-time-budget=60000", "--dump-dom", page.as_uri()],
            check=True, capture_output=True, text=True, timeout=200)
    answer = Answer()
    answer.feed(ran.stdout)
    complaints = [line for line in ran.stderr.splitlines() if "CONSOLE" in line and "GPU stall due to ReadPixels" not in line]
    assert answer.text, (complaints, ran.stdout[-1000:])
    return json.loads(answer.text), complaints


def main():
    browser, program, *scenes = sys.argv[1:]
    for scene in scenes:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "run", scene, "--steps", "60", "--frames", "0", "--animation", "7", "--quiet", "--out", folder],
                           check=True)
            page, complaints = look(browser, folder)
            print(page)
            assert not complaints, complaints
            assert page["frames"] == 7, page
            assert page["title"] == pathlib.Path(scene).stem + ": animation", page
            assert min(page["drawn"]) > 0.02 * page["points"], page
            assert page["moves"] > 1e-3 and page["again"] == 0, page
            assert page["time"].startswith("t = 0 s"), page
            assert page["dragged"] > 0.01 and page["zoomed"] > page["drawn"][0] and page["reset"] == 0, page
            assert page["played_to"] == 6 and page["gl"] == 0 and not page["text"], page
            whole = pathlib.Path(folder, "animation.html")
            whole.write_text(whole.read_text()[:-200])  # the last frame is not whole any more
            page, complaints = look(browser, folder)
            assert page["frames"] == 6 and min(page["drawn"]) > 0.02 * page["points"] and not complaints, (page, complaints)


main()
