"""Long work: threads, progress, Ctrl-C, memory."""

import os
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import treeform as tf
from support import CUBE, SANITIZED, SPHERES, moved, same_mesh, sphere

tqdm = pytest.importorskip("tqdm")

# Union of many spheres: seconds of work.
CROWD = [sphere(4, center=c) for c in np.random.default_rng(1).random((40, 3)) * 4]


def test_two_threads_run_two_booleans_at_once():
    """Each waits, in its progress, until the other has begun."""
    begun = [threading.Event(), threading.Event()]
    both = []

    def work(i):
        def progress(share):
            begun[i].set()
            if begun[1 - i].wait(30):
                both.append(i)
        made[i] = tf.union(*CROWD[:6], progress=progress).mesh

    made = [None, None]
    workers = [threading.Thread(target=work, args=(i,)) for i in (0, 1)]
    for one in workers:
        one.start()
    for one in workers:
        one.join()
    assert set(both) == {0, 1}
    assert same_mesh(*made)


def test_other_threads_run_meanwhile():
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    other = threading.Thread(target=tick)
    other.start()
    tf.union(*CROWD[:8])
    done.set()
    other.join()
    assert len(ticks) > 3


def test_one_mesh_may_be_asked_by_many_threads():
    ball = sphere(4)
    points = np.random.default_rng(2).random((20_000, 3))
    answers = [None] * 6

    def ask(i):
        answers[i] = tf.closest_point(ball, points).distance

    workers = [threading.Thread(target=ask, args=(i,)) for i in range(6)]
    for one in workers:
        one.start()
    for one in workers:
        one.join()
    assert all(np.array_equal(answers[0], one) for one in answers)


def test_progress_is_told_and_goes_up():
    told = []
    tf.union(*CROWD[:8], progress=told.append)
    assert told[-1] == 1 and told == sorted(told)
    assert all(0 <= share <= 1 for share in told)


def test_a_bar_of_tqdm_will_do():
    with open(os.devnull, "w") as nowhere, tqdm.tqdm(total=1, file=nowhere) as bar:
        tf.resolve_self_intersections(SPHERES, progress=bar)
        assert bar.n == pytest.approx(1)


@pytest.mark.parametrize("verb", [
    lambda p: tf.closest_pair(CUBE, SPHERES, progress=p),
    lambda p: tf.find_features(CUBE, progress=p), lambda p: tf.find_invalid_faces(CUBE, progress=p),
    lambda p: tf.count_topology(CUBE, progress=p), lambda p: tf.face_components(CUBE, progress=p),
    lambda p: tf.count_inside_out(CUBE, progress=p),
    lambda p: tf.faces_in_box(CUBE, [0] * 3, [1] * 3, progress=p),
    lambda p: tf.intersection_curves(SPHERES, tf.self_intersections(SPHERES), progress=p),
    lambda p: tf.intersection_regions(SPHERES, tf.self_intersections(SPHERES), progress=p),
    lambda p: tf.join_equal_points(CUBE, progress=p),
    lambda p: tf.rounded(CUBE.vertices, progress=p),
    lambda p: tf.count_nearly_equal(CUBE.vertices, 0.5, progress=p)])
def test_all_work_tells_its_progress(verb):
    told = []
    verb(told.append)
    assert told[0] == 0 and told[-1] == 1
    with pytest.raises(tf.Cancelled):
        verb(lambda share: False)


def test_progress_of_work_in_pieces_goes_up_once():
    told = []
    tf.PointTree(CUBE.vertices).query_ball_point(CUBE.vertices, range(8), progress=told.append)
    assert told == sorted(told) and told[0] == 0 and told[-1] == 1


def test_progress_may_stop_the_work():
    with pytest.raises(tf.Cancelled):
        tf.union(*CROWD, progress=lambda share: False)
    with pytest.raises(tf.Cancelled):
        tf.PointTree(np.zeros((5, 3))).query([0, 0, 0], progress=lambda share: False)
    assert tf.union(CUBE).mesh.volume == 1


def test_a_result_that_is_there_is_returned():
    told = []
    made = tf.union(CUBE, progress=lambda share: told.append(share) or share < 1)
    assert told[0] == 0 and told[-1] == 1 and made.mesh.volume == 1


@pytest.mark.parametrize("format", ["off", "obj", "3mf"])
def test_a_cancelled_write_leaves_the_file(tmp_path, format):
    path = tmp_path / f"m.{format}"
    tf.write(path, CUBE)
    before = path.read_bytes()
    soup = np.random.default_rng(1).random((900_000, 3)), np.arange(900_000).reshape(-1, 3)
    calls = []

    def progress(share):
        calls.append(share)
        return len(calls) == 1

    def interrupt(share):
        if len(calls) == 3:
            raise KeyError("mine")
        calls.append(share)

    for stop, error in ((progress, tf.Cancelled), (interrupt, KeyError)):
        with pytest.raises(error):
            tf.write(path, soup, progress=stop)
        deadline = time.monotonic() + 60
        while len(os.listdir(tmp_path)) > 1 and time.monotonic() < deadline:
            time.sleep(0.01)
        assert path.read_bytes() == before and os.listdir(tmp_path) == [path.name]


def test_what_progress_raises_comes_through():
    def progress(share):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        tf.union(*CROWD, progress=progress)
    with pytest.raises(KeyError, match="mine"):
        tf.closest_point(sphere(4), np.zeros((10, 3)), progress=progress)


@pytest.mark.parametrize("verb", [
    "tf.union(*crowd)", "tf.self_intersections(soup)", "tf.wrap(crowd[0], 0.002)",
    "tf.repair(soup, max_loss=1, check=False)", "tf.weld(cloud, 0.05, chain=True)",
    "tf.PointTree(cloud).query_pairs(0.05, output_type='ndarray')",
    "tf.closest_point(crowd[0], far)", "boxes.pairs()", "boxes.pairs(boxes)",
    "boxes.query([[0] * 3] * 3000, [[1] * 3] * 3000)", "same.query_ball([0] * 3, 1)",
    "same.query_ball_point([0] * 3, 1)", "same.query([0] * 3, 10_000_000)"])
def test_ctrl_c_stops_the_work(verb):
    """The work would take many seconds; the process sends itself the signal soon after it has
    begun. A job that does not notice is left alone, and the next one runs beside it."""
    program = f"""
import os, signal, sys, threading
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it
import numpy as np
import treeform as tf
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
from support import sphere
ball = sphere(5)
crowd = [(ball.vertices + c, ball.faces) for c in np.random.default_rng(1).random((400, 3)) * 2]
soup = (np.random.default_rng(2).random((60_000, 3)), np.arange(60_000).reshape(-1, 3))
cloud = np.random.default_rng(3).random((1_000_000, 3))
far = np.random.default_rng(4).random((3_000_000, 3)) * 50
if "boxes" in {verb!r}:
    boxes = tf.BoxTree(np.zeros((30_000, 3)), np.ones((30_000, 3)))
if "same" in {verb!r}:
    same = tf.PointTree(cloud[:1] + np.zeros((4_000_000, 3)) * cloud[0])
threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    {verb}
except KeyboardInterrupt:
    print("stopped", tf.union(ball).certificate, flush=True)
else:
    print("finished", flush=True)
os._exit(0)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                          timeout=300)
    assert done.stdout.split()[:1] == ["stopped"], done.stdout + done.stderr


def test_a_process_ends_after_ctrl_c():
    program = """
import os, signal, threading
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it
import numpy as np
import treeform as tf
soup = (np.random.default_rng(2).random((3_000, 3)), np.arange(3_000).reshape(-1, 3))
threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
tf.repair(soup, max_loss=1, check=False, progress=lambda share: None)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                          timeout=300)
    assert done.returncode == -signal.SIGINT and "KeyboardInterrupt" in done.stderr, done.stderr


@pytest.mark.parametrize("verb", ["tf.read(pipe, 'ply')", "tf.check_operand(tf.read(pipe, 'ply'))",
                                  "boxes.pairs()"])
@pytest.mark.parametrize("end", ["raise", "print('ended'); sys.exit(7)"])
def test_a_process_ends_though_its_job_goes_on(tmp_path, verb, end):
    """Nobody will ever write into the pipe, and the pairs would take minutes."""
    pipe = str(tmp_path / "pipe.ply")
    os.mkfifo(pipe)
    program = f"""
import atexit, os, signal, sys, threading
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it
import numpy as np
import treeform as tf
pipe = {pipe!r}
boxes = tf.BoxTree(np.zeros((200_000, 3)), np.ones((200_000, 3))) if "boxes" in {verb!r} else None
threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    {verb}
except KeyboardInterrupt:
    {end}
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                          timeout=100)
    if end == "raise":
        assert done.returncode == -signal.SIGINT and "KeyboardInterrupt" in done.stderr, done.stderr
    else:
        assert (done.returncode, done.stdout, done.stderr) == (7, "ended\n", "")


@pytest.mark.parametrize("name", ["m.obj", "m.ply", "m.3mf"])
def test_ctrl_c_leaves_no_part_of_a_file(tmp_path, name):
    program = f"""
import os, signal, threading
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it
import numpy as np
import treeform as tf
soup = tf.Mesh(np.random.default_rng(1).random((900_000, 3)), np.arange(900_000).reshape(-1, 3))
threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
while True:
    tf.write({str(tmp_path / name)!r}, soup)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                          timeout=300)
    assert done.returncode == -signal.SIGINT and set(os.listdir(tmp_path)) <= {name}


@pytest.mark.parametrize("verb", ["tf.self_intersections(soup)", "tf.union(ball)", "tree.query(x)",
                                  "tf.check_operand(small)"])
def test_a_process_ends_while_daemon_threads_work(verb):
    program = f"""
import atexit, sys, threading, time
import numpy as np
atexit.register(lambda: print(tf.union(ball).mesh.is_solid, flush=True))
import treeform as tf
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
from support import CUBE as small, sphere
ball, x = sphere(4), np.random.default_rng(1).random((500_000, 3))
soup, tree = (x[:9_000], np.arange(9_000).reshape(-1, 3)), tf.PointTree(x)
def work():
    while True:
        {verb}
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)
"""
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                              timeout=300)
        assert (done.returncode, done.stdout, done.stderr) == (0, "True\n", "")


def test_a_fork_works_on():
    tf.union(*CROWD[:4])  # there are helper threads now
    child = os.fork()
    if child == 0:
        try:
            os._exit(0 if tf.union(*CROWD[:4]).certificate else 1)
        except BaseException:
            os._exit(2)
    deadline = time.monotonic() + 120
    while time.monotonic() < deadline:
        pid, status = os.waitpid(child, os.WNOHANG)
        if pid:
            assert os.waitstatus_to_exitcode(status) == 0
            return
        time.sleep(0.05)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    pytest.fail("the child hangs")


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


@pytest.mark.skipif(SANITIZED, reason="a sanitizer keeps memory")
def test_memory_does_not_grow():
    a, b = sphere(3), moved(sphere(3), 0.5, 0.1, 0.2)

    def many(count):
        for _ in range(count):
            (a.vertices, a.faces)
            tf.union((a.vertices, a.faces), (b.vertices, b.faces))

    many(100)
    before = resident()
    many(1000)
    assert resident() - before < 16 << 20


def test_threads_may_be_limited():
    most = tf.thread_count()
    with tf.threads(1):
        assert tf.thread_count() == 1
    assert tf.thread_count() == most
