"""Sweeps by dask.distributed: a scheduler and workers as processes of their own, one of which is
killed and one of which comes late; the same tables, byte for byte.

    PYTHONPATH=$PWD/build/ci/python python3 distributed_test.py SHOAL        (workers start elsewhere)
"""

import os
import re
import signal
import subprocess
import sys
import time

import desk
import shoal
import shoal.distributed
from distributed import Client
from study_desk import SHORT, STUDY, StudyDesk

LONG = STUDY.replace("replications = 3", "replications = 8").replace("= 300", "= 3600")

FAILING = """scenario = "redsea_square"
replications = 2
set = { trial.duration_s = 60 }
[[factor]]
name = "late"
key = "current.netcdf.time_offset_s"
values = [0, 1000000]
"""


OWN = """import sys

import numpy
import shoal
import shoal.distributed
from distributed import Client


@shoal.behaviour
class Half:
    def __init__(self, share: float = 0.5):
        self.share = share

    def targets(self, seen):
        return self.share * numpy.nanmean(seen.positions, axis=1)


@shoal.measure
class Farthest:
    values = {"farthest_m": ("m", "from the origin")}

    def finish(self, world):
        return {"farthest_m": numpy.linalg.norm(world.positions, axis=1).max()}


def law(r, s):
    return (r - s)**2 / s


study = {
    "scenario": "construction_hexagonal", "replications": 2,
    "set": {"trial.duration_s": 120, "behaviour.attraction_repulsion.potential": shoal.potential(law, batch=True)},
    "factor": [{"key": "behaviour.kind", "values": ["half", "attraction_repulsion"]},
               {"key": "behaviour.half.share", "values": [0.1, 0.9]}]}
here = shoal.sweep(study, "here", jobs=2)
there = shoal.distributed.sweep(study, Client(sys.argv[1]), "there")
assert here.to_csv() == there.to_csv(), (here, there)
assert set(there.status) == {"done"} and there.farthest_m.nunique() == 6, there.farthest_m
print("the same", len(there), "trials")
"""


class Cluster:
    """A scheduler and workers on loopback."""

    def __init__(self, folder, workers, threads=1):
        self.folder, self.threads = folder, threads
        self.processes = []
        self.address = f"tcp://127.0.0.1:{self._scheduler()}"
        self.workers = [self.start_worker() for _ in range(workers)]

    def _start(self, name, *words, **settings):
        with open(self.folder / name, "w", encoding="utf-8") as log:
            process = subprocess.Popen([sys.executable, "-m", *words], cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=log, **settings)
        self.processes.append(process)
        return process

    def _scheduler(self):
        self._start("scheduler.log", "distributed.cli.dask_scheduler", "--host", "127.0.0.1",
                    "--port", "0", "--no-dashboard")
        for _ in range(600):
            found = re.search(r"tcp://127\.0\.0\.1:(\d+)", (self.folder / "scheduler.log").read_text())
            if found:
                return found.group(1)
            time.sleep(0.1)
        raise RuntimeError("the scheduler does not start")

    def start_worker(self, **settings):
        return self._start(f"worker-{len(self.processes)}.log", "distributed.cli.dask_worker",
                           self.address, "--nthreads", str(self.threads), "--nworkers", "1", "--no-nanny",
                           "--no-dashboard", "--local-directory", str(self.folder), **settings)

    def stop(self):
        for process in self.processes:
            process.kill()
            process.wait()


class Distributed(StudyDesk):
    def cluster(self, workers, threads=1):
        folder = self.desk / "cluster"
        folder.mkdir(exist_ok=True)
        cluster = Cluster(folder, workers, threads)
        self.addCleanup(cluster.stop)
        client = Client(cluster.address, timeout=60)
        self.addCleanup(client.close)
        if workers:  # dask waits for one at least
            client.wait_for_workers(workers, timeout=60)
        return cluster, client

    def assert_same_study(self, one, other):
        self.assertEqual(self.tables(one), self.tables(other))
        columns = "trial_key, trial_id, seed, status, energy_mean_wh, quality_final_m"
        self.assertEqual(self.rows(columns, one), self.rows(columns, other))

    def test_the_tables_are_those_of_one_machine_with_a_worker_killed_and_one_late(self):
        self.write("study.toml", LONG)
        self.sweep(out="one")
        cluster, client = self.cluster(2)
        events = []

        def watch(counts):
            if counts["done"] == 4 and not events:
                events.append("killed")
                os.kill(cluster.workers[0].pid, signal.SIGKILL)
                cluster.start_worker()

        frame = shoal.distributed.sweep(self.desk / "study.toml", client, self.desk / "many",
                                        progress=watch)
        self.assertEqual(events, ["killed"])
        self.assertEqual(len(frame), 24)
        self.assertEqual(set(frame.status), {"done"})
        self.assert_same_study("one", "many")
        late = [worker for worker in client.scheduler_info()["workers"].values()]
        self.assertEqual(len(late), 2)

    def test_the_program_does_the_same(self):
        self.write("study.toml", SHORT)
        self.sweep(out="one")
        cluster, _ = self.cluster(1)
        done = self.shoal("sweep", "study.toml", "--dask", cluster.address, "--out", "many",
                          "--batch", "4")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("many: 9 of 9 trials are stored, 9 of them run now", done.stdout)
        self.assert_same_study("one", "many")
        again = self.shoal("sweep", "study.toml", "--dask", cluster.address, "--out", "many")
        self.assertIn("many: 9 of 9 trials are stored, 0 of them run now", again.stdout)
        self.assertNotIn("figures", again.stdout)  # left out by self.shoal()

    def test_trials_that_fail_are_stored_as_such(self):
        self.write("sea.toml", FAILING)
        cluster, client = self.cluster(1)
        frame = shoal.distributed.sweep(self.desk / "sea.toml", client, self.desk / "many")
        self.assertTrue((frame.status == "failed").any())
        self.sweep(study="sea.toml", out="one")
        self.assertEqual(self.rows("trial_key, status, reason", "one"),
                         self.rows("trial_key, status, reason", "many"))

    def test_classes_and_functions_of_ones_own_go_to_the_workers(self):
        self.write("own.py", OWN)
        cluster, _ = self.cluster(1, threads=2)
        done = subprocess.run([sys.executable, "-W", "ignore", "own.py", cluster.address], cwd=self.desk, text=True,
                              capture_output=True, timeout=120)
        self.assertEqual((done.returncode, done.stdout), (0, "the same 8 trials\n"), done.stderr)

    def test_a_worker_of_another_shoal_is_refused(self):
        self.write("study.toml", SHORT)
        _, client = self.cluster(1)
        client.run(_pretend_to_be_another)
        with self.assertRaisesRegex(shoal.InputError, "install the same shoal on all machines"):
            shoal.distributed.sweep(self.desk / "study.toml", client, self.desk / "out")

    def test_a_scheduler_that_is_lost_is_reported_and_the_sweep_goes_on_elsewhere(self):
        self.write("study.toml", LONG)
        cluster, client = self.cluster(1)

        def kill(counts):
            if counts["done"] == 2:
                cluster.processes[0].kill()

        with self.assertRaisesRegex(shoal.SystemError, "the scheduler of dask is lost.*sweep again"):
            shoal.distributed.sweep(self.desk / "study.toml", client, self.desk / "out", progress=kill)
        stored = len(self.rows("trial_key"))
        self.assertGreaterEqual(stored, 2)
        said = self.sweep()
        self.assertIn(f"24 of 24 trials are stored, {24 - stored} of them run now", said)

    def test_a_worker_without_the_package_is_named(self):
        self.write("study.toml", SHORT)
        cluster, client = self.cluster(0)
        bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        cluster.start_worker(env=bare)
        client.wait_for_workers(1, timeout=60)
        worker = next(iter(client.scheduler_info()["workers"]))
        done = self.shoal("sweep", "study.toml", "--dask", cluster.address)
        self.assert_complains(done, 1, [f"the worker {worker} cannot import shoal", "PYTHONPATH="])

    def test_a_sweep_without_workers_says_that_it_waits(self):
        self.write("study.toml", SHORT)
        cluster, _ = self.cluster(0)
        with subprocess.Popen([desk.SHOAL, "sweep", "study.toml", "--dask", cluster.address],
                              cwd=self.desk, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as waiting:
            self.assertIn("no worker has joined", waiting.stderr.readline())
            cluster.start_worker()
            said, _ = waiting.communicate(timeout=120)
            self.assertEqual(waiting.returncode, 0)
        self.assertIn("written: out/study/figures, each as .pdf and .svg\n", said)
        self.assertTrue(list((self.desk / "out" / "study" / "figures").glob("*.svg")))

    def test_workers_that_die_of_a_trial_are_told(self):
        self.write("study.toml", SHORT)
        cluster, client = self.cluster(1)
        client.run_on_scheduler(_allow_no_failure)
        client.run(_die_of_trials)
        cluster.start_worker()
        with self.assertRaisesRegex(shoal.SystemError, "dies of a trial.*sweep again"):
            shoal.distributed.sweep(self.desk / "study.toml", client, self.desk / "out")

    def test_what_cannot_be_reached_is_reported(self):
        done = self.shoal("sweep", "study.toml", "--dask", "tcp://127.0.0.1:1", "--out", "out")
        self.assert_complains(done, 1, ["no scheduler of dask answers at tcp://127.0.0.1:1",
                                        "start dask-scheduler"])
        done = self.shoal("sweep", "study.toml", "--dask", "here", "--shard", "1/2")
        self.assert_complains(done, 2, ["--dask takes neither --shard"])
        done = self.shoal("sweep", "study.toml", "--dask", "here", "--jobs", "2")
        self.assert_complains(done, 2, ["--jobs excludes --dask"])
        done = self.shoal("sweep", "study.toml", "--batch", "2")
        self.assert_complains(done, 2, ["--batch requires --dask"])

    def test_the_overhead_of_a_task_is_printed(self):
        tiny = ('scenario = "construction_square"\nreplications = 300\n'
                'set = { trial.duration_s = 10, quality.every_s = 0 }\n')
        self.write("study.toml", tiny)
        _, client = self.cluster(1)
        shoal.distributed.sweep(self.desk / "study.toml", client, self.desk / "warm", replications=5)
        began = time.monotonic()
        shoal.distributed.sweep(self.desk / "study.toml", client, self.desk / "many")
        many = time.monotonic() - began
        began = time.monotonic()
        shoal.sweep(self.desk / "study.toml", self.desk / "one", jobs=1)
        one = time.monotonic() - began
        print(f"300 trials of {1e3 * one / 300:.1f} ms: {1e3 * (many - one) / 300:.1f} ms more a task "
              "by one worker of dask", file=sys.stderr)


def _pretend_to_be_another():
    from shoal import _shoal

    answer = _shoal.answer
    _shoal.answer = lambda request: answer(request.replace(_shoal.program(), "0.0.0-another"))


def _die_of_trials():
    from shoal import _shoal

    _shoal.answer = lambda request: os.kill(os.getpid(), signal.SIGKILL)


def _allow_no_failure(dask_scheduler):
    dask_scheduler.allowed_failures = 0


if __name__ == "__main__":
    desk.main()
