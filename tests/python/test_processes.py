"""Work that many processes do in one folder: step by step, and as a team."""

import multiprocessing
import threading

import numpy as np
import pytest

import treeform as tf
from support import soup

SPAWN = multiprocessing.get_context("spawn")


class Pipes:
    """A team whose members tell each other what they tell by way of the process that started them;
    as `mpi4py.MPI.COMM_WORLD` would."""

    def __init__(self, rank, size, pipe):
        self.rank, self.size, self._pipe = rank, size, pipe

    def allgather(self, told):
        self._pipe.send(told)
        return self._pipe.recv()


def member(work, rank, size, pipe, results):
    try:
        made = work(Pipes(rank, size, pipe))
    except Exception as fault:
        made = type(fault).__name__, str(fault)
    results.put((rank, made))
    pipe.send(None)


def in_communicator(size, work):
    """What `work(team)` returns in each of so many processes."""
    results = SPAWN.Queue()
    pipes = [SPAWN.Pipe() for _ in range(size)]
    processes = [SPAWN.Process(target=member, args=(work, rank, size, pipes[rank][1], results))
                 for rank in range(size)]
    for one in processes:
        one.start()

    def pass_on():
        while True:
            told = [here.recv() for here, _ in pipes]
            if any(one is None for one in told):
                assert all(one is None for one in told), "not all came to the same place"
                return
            for here, _ in pipes:
                here.send(told)

    between = threading.Thread(target=pass_on, daemon=True)
    between.start()
    made = dict(results.get(timeout=120) for _ in range(size))
    for one in processes:
        one.join()
    between.join(timeout=10)
    assert not between.is_alive()
    return [made[rank] for rank in range(size)]


class Search:
    def __init__(self, path, **options):
        self.path, self.options = path, options

    def __call__(self, team):
        path = self.path[team.rank] if isinstance(self.path, list) else self.path
        found = tf.self_intersections_of_file(path, communicator=team, **self.options)
        return found.pairs_in_file, found.tiles


class Weld:
    def __init__(self, path, out, **options):
        self.path, self.out, self.options = path, out, options

    def __call__(self, team):
        path = self.path[team.rank] if isinstance(self.path, list) else self.path
        return tf.weld_stream(path, self.out, 0.1, communicator=team, **self.options)


@pytest.fixture
def cloud(tmp_path):
    tf.write(tmp_path / "cloud.ply", (np.random.default_rng(3).random((20_000, 3)) * 10, []))
    return tmp_path / "cloud.ply"


def test_a_team_searches_a_file(tmp_path):
    tf.write(tmp_path / "soup.ply", soup(3, 400))
    whole = tf.self_intersections_of_file(tmp_path / "soup.ply")
    first, *others = in_communicator(3, Search(tmp_path / "soup.ply", faces_per_tile=50))
    assert first[1] > 3 and np.array_equal(first[0], whole.pairs_in_file)
    assert all(len(pairs) == 0 for pairs, _ in others)
    assert [path.name for path in tmp_path.iterdir()] == ["soup.ply"]


def test_a_team_welds_a_cloud(tmp_path, cloud):
    whole = tf.weld_stream(cloud, tmp_path / "whole.ply", 0.1)
    made = in_communicator(3, Weld(cloud, tmp_path / "thin.ply", points_per_tile=2000))
    assert made[0].tiles > 5 and made[0].kept == whole.kept < 20_000
    assert (tmp_path / "thin.ply").read_bytes() == (tmp_path / "whole.ply").read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cloud.ply", "thin.ply",
                                                                "whole.ply"]


def test_where_one_fails_all_do(tmp_path, cloud):
    paths = [cloud, tmp_path / "none.ply"]
    first, second = in_communicator(2, Weld(paths, tmp_path / "thin.ply",
                                            folder=tmp_path / "tiles"))
    assert first[0] == "Error" and "process 1: " in first[1] and "none.ply" in first[1]
    assert second[0] == "FileError" and "none.ply" in second[1]
    assert not (tmp_path / "thin.ply").exists()


class Impatient(Weld):
    """The second is interrupted: as by Ctrl-C, or because its progress has said so."""

    def __call__(self, team):
        def progress(share):
            if self.error is not None:
                raise self.error
            return False

        try:
            return tf.weld_stream(self.path, self.out, 0.1, communicator=team, points_per_tile=2000,
                                  progress=progress if team.rank == 1 else None)
        except KeyboardInterrupt as error:
            raise RuntimeError("stopped by hand") from error


@pytest.mark.parametrize("error", [None, KeyboardInterrupt()])
def test_where_one_is_interrupted_nobody_waits(tmp_path, cloud, error):
    work = Impatient(cloud, tmp_path / "thin.ply")
    work.error = error
    first, second, third = in_communicator(3, work)
    ready = (tmp_path / "thin.ply").exists()  # before the others heard of that
    for other in (first, third):
        assert ready or other == ("Error", "process 1: interrupted")
    assert second == (("Cancelled", "progress returned False") if error is None
                      else ("RuntimeError", "stopped by hand"))
    if ready:
        tf.weld_stream(cloud, tmp_path / "whole.ply", 0.1)
        assert (tmp_path / "thin.ply").read_bytes() == (tmp_path / "whole.ply").read_bytes()


def test_many_processes_weld_a_cloud(tmp_path, cloud):
    tf.weld_stream(cloud, tmp_path / "whole.ply", 0.1, removed=tmp_path / "removed.ply")
    options = {"folder": tmp_path / "tiles", "points_per_tile": 2000}
    first = tf.SharedWeld(cloud, 0.1, **options)
    with pytest.raises(tf.FileError, match="tiles"):
        first.weld_tile(0)
    with pytest.raises(tf.FileError, match="tiles"):
        first.finish(tmp_path / "thin.ply")
    first.close()
    with pytest.raises(ValueError, match="closed"):
        first.scatter()
    first = tf.SharedWeld(cloud, 0.1, **options)
    count = first.scatter()
    assert count == first.tiles > 5
    with pytest.raises(IndexError, match=str(count)):
        first.weld_tile(count)
    with pytest.raises(tf.FileError, match="0"):
        first.finish(tmp_path / "thin.ply")
    with SPAWN.Pool(2) as pool:
        pool.starmap(tf.SharedWeld.weld_tile, [(first, tile) for tile in range(count)])
        pool.close()
        pool.join()
    first.close()
    with tf.SharedWeld(cloud, 0.1, **options) as last:
        made = last.finish(tmp_path / "thin.ply", removed=tmp_path / "gone.ply")
        last.remove_folder()
    assert made.points == 20_000 and made.tiles == count
    for mine, theirs in (("thin", "whole"), ("gone", "removed")):
        assert ((tmp_path / f"{mine}.ply").read_bytes()
                == (tmp_path / f"{theirs}.ply").read_bytes())
    assert not (tmp_path / "tiles").exists()
    with pytest.raises(tf.Cancelled):
        tf.SharedWeld(cloud, 0.1, **options).scatter(progress=lambda share: False)
    with pytest.raises(ValueError, match="keep"):
        tf.SharedWeld(cloud, 0.1, keep="mid")
    with pytest.raises(ValueError, match="files"):
        tf.SharedWeld([], 0.1)
    with pytest.raises(tf.FileError, match="none"):
        tf.SharedWeld(tmp_path / "none.ply")


def test_a_file_is_searched_by_many_processes(tmp_path):
    path, folder = tmp_path / "soup.ply", tmp_path / "tiles"
    rng = np.random.default_rng(3)
    tf.write(path, tf.Mesh(rng.random((900, 3)), np.arange(900).reshape(-1, 3)))
    whole = tf.self_intersections_of_file(path, kinds=["crossing", "pierce"])
    first = tf.SharedSearch(path, folder=folder, faces_per_tile=50, kinds=["crossing", "pierce"])
    with pytest.raises(tf.FileError, match="tiles"):
        first.search_tile(0)
    with pytest.raises(tf.FileError, match="tiles"):
        assert first.tiles
    count = first.scatter()
    assert count == first.tiles > 3 and first.unfinished == list(range(count))
    with pytest.raises(tf.FileError, match="0"):
        first.finish()
    with pytest.raises(IndexError, match=f"^tile {count} of {count}$"):
        first.search_tile(count)
    with pytest.raises(ValueError, match="tile: .* not -1"):
        first.search_tile(-1)
    first.search_tile(1)
    assert first.unfinished == [0, *range(2, count)]
    with pytest.raises(tf.Cancelled):
        first.search_tile(2, progress=lambda share: False)
    with SPAWN.Pool(2) as pool:
        pool.starmap(tf.SharedSearch.search_tile, [(first, tile) for tile in range(count)])
    assert first.unfinished == []
    found = first.finish()
    assert found.counts == whole.counts and np.array_equal(found.pairs_in_file, whole.pairs_in_file)
    assert found.tiles == count and found.counts["touching"] == 0
    first.remove_folder()
    first.close()
    assert list(tmp_path.iterdir()) == [path]
    with pytest.raises(ValueError, match="closed"):
        assert first.unfinished
    with pytest.raises(ValueError, match="kinds"):
        tf.SharedSearch(path, kinds=["crosing"])
    with pytest.raises(tf.FileError, match="no_such"):
        tf.SharedSearch(tmp_path / "no_such.ply").scatter()
    assert list(tmp_path.iterdir()) == [path]
