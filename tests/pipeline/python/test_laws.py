"""Laws of drives that are written in Python, on the small lift."""

import json
import math
import os
import shutil
import signal
import subprocess
import sys
import threading
import unittest
from pathlib import Path

import numpy as np

import blocklift
from small_lift import MECHANISMS, InATemporaryFolder

# The second hook follows the first, which is lowered.
FOLLOW = {"law": "follow", "reaction": "0.5 s",
          "sees": {"height": {"level": "C1.right", "with": "C1.left"}}}


class LawTest(InATemporaryFolder):
    def case(self, *moves):
        case = blocklift.Case("lift")
        case.set("operation", [{"stage": "steer", "moves": list(moves)}])
        return case

    def follow(self, keeps):
        return self.case({"drives": ["C1.left"], "by": "1 m", "speed": "5 m/min"},
                         {"drives": ["C1.right"], "keeps": keeps})

    def hoist(self, **keeps):
        return self.case({"drives": ["C1.left", "C1.right"], "duration": "40 s",
                          "keeps": {"law": "go", "reaction": "0 s", **keeps}})

    def test_without_laws_it_gives_the_figures_of_the_program(self):
        case = blocklift.Case("lift")
        theirs = case.simulate("theirs").history("dynamic")
        ours = case.simulate("ours", laws={}).history("dynamic")
        for name in theirs.data_vars:
            np.testing.assert_allclose(ours[name], theirs[name], rtol=1e-9, atol=1e-6,
                                       err_msg=str(name))

    def test_keys_of_models_are_set_in_this_process_too(self):
        case = blocklift.Case("lift")
        case.set("block:mass", "9 t")
        theirs = case.simulate("theirs").history("static").tension
        ours = case.simulate("ours", laws={}).history("static").tension
        np.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-6)
        case.set("block:mas", "9 t")
        with self.assertRaisesRegex(blocklift.InputError, "there is no mas to change"):
            case.assess("assessed", laws={})

    def test_a_law_that_keeps_level_is_the_built_in_wish(self):
        built_in = self.follow({"level": "C1.right", "with": "C1.left", "reaction": "0.5 s",
                                "correction": "4 s"}).simulate("built-in").history("dynamic")
        seen_by = []

        def follow(time, seen):
            seen_by.append((time, seen))
            return seen["height"] / 4

        own = self.follow(FOLLOW).simulate("own", laws={"follow": follow}).history("dynamic")
        np.testing.assert_allclose(own.hoist_length, built_in.hoist_length, atol=1e-12)
        np.testing.assert_allclose(own.tension, built_in.tension, atol=1e-3)
        # It ends with the leader's move, part of its lag of 4 s times 5 m/min behind.
        last = float(own.hoist_length.sel(hoist="C1.right")[-1])
        self.assertTrue(6 - 4 * 5 / 60 < last < 6, last)
        times, figures = zip(*seen_by)
        np.testing.assert_allclose(np.diff(times), 0.5 / 3, atol=1e-9)
        self.assertEqual(set(figures[0]), {"position", "speed", "height"})
        self.assertAlmostEqual(figures[0]["position"], 5)
        self.assertEqual(figures[0]["speed"], 0)

    def test_a_proportional_hoist_decays_as_it_should(self):
        # L' = (goal - L) / T, acted on an interval and a half later: exp(-rate t), where
        # rate = exp(1.5 rate interval) / T.
        goal, correction, interval = 4.0, 5.0, 0.05
        case = self.hoist(every=f"{interval} s")
        motion = case.simulate(
            "out", laws={"go": lambda time, seen: (goal - seen["position"]) / correction})
        length = motion.history("dynamic").hoist_length.sel(hoist="C1.left")
        left = [float(length.interp(time=time)) - goal for time in (20.0, 35.0)]
        rate = 1 / correction
        for _ in range(20):
            rate = math.exp(1.5 * rate * interval) / correction
        self.assertAlmostEqual(math.log(left[0] / left[1]) / 15 / rate, 1, delta=1e-3)

    def test_a_class_is_a_law_with_a_memory_for_each_drive(self):
        made = []

        class Steps:
            def __init__(self):
                made.append(self)
                self.looks = 0

            def __call__(self, time, seen):
                self.looks += 1
                return np.float64(0.01 if self.looks < 50 else 0.0)

        motion = self.hoist().simulate("out", laws={"go": Steps}).history("dynamic")
        self.assertEqual(len(made), 2)
        self.assertEqual({law.looks for law in made}, {200})
        self.assertAlmostEqual(float(motion.hoist_length.sel(hoist="C1.right")[-1]),
                               5 + 0.01 * 49 * 0.2, delta=1e-6)

    def test_what_a_law_raises_ends_the_run(self):
        class OutOfSight(Exception):
            pass

        raised = OutOfSight("fog")

        def law(time, seen):
            if time > 3:
                raise raised
            return 0.0

        with self.assertRaises(OutOfSight) as caught:
            self.hoist().simulate("out", laws={"go": law})
        self.assertIs(caught.exception, raised)
        self.assertFalse(Path("out/results.h5").exists())

        class CannotBegin:
            def __init__(self):
                raise raised

        with self.assertRaises(OutOfSight):
            self.hoist().simulate("out", laws={"go": CannotBegin})

    def test_what_is_no_speed_ends_the_run(self):
        with self.assertRaisesRegex(blocklift.RunError, 'law "go" gave drive "C1.left" the speed'):
            self.hoist().simulate("out", laws={"go": lambda time, seen: math.nan})
        for wrong in (None, "0.1", [0.1]):
            with self.assertRaisesRegex(TypeError, 'law "go" gave .* at 0 s; it must give a speed'):
                self.hoist().simulate("out", laws={"go": lambda time, seen, wrong=wrong: wrong})
        with self.assertRaisesRegex(TypeError, "cannot be called"):
            self.hoist().simulate("out", laws={"go": 0.1})
        with self.assertRaises(TypeError):  # takes no arguments
            self.hoist().simulate("out", laws={"go": lambda: 0.1})

    def test_ctrl_c_ends_the_run(self):
        def law(time, seen):
            signal.raise_signal(signal.SIGINT)
            return 0.0

        with self.assertRaises(KeyboardInterrupt):
            self.hoist().simulate("out", laws={"go": law})
        # Where no law is asked, too.
        case = blocklift.Case("lift")
        case.set("settle", "2000 s")
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            case.simulate("out", laws={})

    def test_other_threads_go_on_meanwhile(self):
        counted = [0]
        done = threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                done.wait(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        try:
            case = blocklift.Case("lift")
            case.set("settle", "100 s")
            before = counted[0]
            case.simulate("out", laws={})
            self.assertGreater(counted[0] - before, 20)
        finally:
            done.set()
            thread.join()

    def test_threads_take_turns(self):
        case = self.hoist()
        lengths = {}

        def lift(name, speed):
            motion = case.simulate(name, laws={"go": lambda time, seen: speed}).history("dynamic")
            lengths[name] = float(motion.hoist_length.sel(hoist="C1.left")[-1])

        threads = [threading.Thread(target=lift, args=(f"out-{k}", k / 1000)) for k in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(sorted(lengths), ["out-0", "out-1", "out-2"])
        self.assertAlmostEqual(lengths["out-0"], 5, places=9)
        self.assertAlmostEqual(lengths["out-2"] - 5, 2 * (lengths["out-1"] - 5), places=3)

    def test_a_full_disk_is_an_error_and_no_crash(self):
        # Python's own process writes the results, and ends by itself thereafter.
        ended = subprocess.run(
            [sys.executable, "-c",
             "import blocklift, resource\n"
             "resource.setrlimit(resource.RLIMIT_FSIZE, (20000, resource.RLIM_INFINITY))\n"
             "try:\n"
             "    blocklift.Case('lift').simulate('out', laws={})\n"
             "except blocklift.RunError as error:\n"
             "    print(error)\n"],
            capture_output=True, text=True)
        self.assertIn("File too large", ended.stdout)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertFalse(Path("out").exists())

    def test_a_law_cannot_begin_a_lift(self):
        case = self.hoist()

        def law(time, seen):
            case.simulate("inner", laws={"go": lambda time, seen: 0.0})
            return 0.0

        with self.assertRaisesRegex(blocklift.RunError, "a law cannot begin a lift"):
            case.simulate("outer", laws={"go": law})
        self.assertFalse(Path("inner").exists())
        # The next one runs.
        case.simulate("outer", laws={"go": lambda time, seen: 0.0})

    def test_failed_members_are_warned_of_as_the_program_does(self):
        study = self.set_down()
        Path("grid.yaml").write_text(study + "design: grid\n", encoding="utf-8")
        with self.assertRaisesRegex(blocklift.RunError,
                                    "1 of 2 members .*, member 1: stage .* waits for R1"):
            blocklift.sweep("grid.yaml", "grid", laws={})
        self.assertEqual(len(blocklift.Study("grid").members), 2)
        Path("half.yaml").write_text(study + "members: 4\n", encoding="utf-8")
        with self.assertRaisesRegex(blocklift.RunError, "2 of 4 members failed"):
            blocklift.sweep("half.yaml", "half", laws={})
        self.assertEqual(len(blocklift.Study("half").members), 4)
        with self.assertRaisesRegex(ValueError, "leave workers out"):
            blocklift.sweep("grid.yaml", "other", laws={}, workers=0)

    def test_wrong_names_have_their_place_and_a_guess(self):
        def message(case, laws):
            with self.assertRaises(blocklift.InputError) as caught:
                case.simulate("out", laws=laws)
            self.assertEqual(caught.exception.complaints[0].file, str(case.file))
            return caught.exception.complaints[0]

        def stand(time, seen):
            return 0.0

        case = self.case({"drives": ["C1.lft"], "duration": "9 s", "keeps": {"law": "go"}})
        found = message(case, {"go": stand})
        self.assertIn("C1.lft", found.message)
        self.assertIn('did you mean "C1.left"?', found.hints[0])
        self.assertGreater(found.line, 1)
        found = message(self.hoist(), {"go": stand, "goo": stand})
        self.assertIn('law "goo"', found.message)
        self.assertIn('did you mean "go"?', found.hints[0])
        found = message(self.hoist(), {})
        self.assertIn('nobody gives the law "go"', found.message)
        self.assertGreater(found.line, 1)
        found = message(self.hoist(sees={"pull": {"tension": "R11"}}), {"go": stand})
        self.assertIn('did you mean "R1"?', found.hints[0])
        with self.assertRaisesRegex(blocklift.InputError, 'steered by a law "go"'):
            blocklift.Case(MECHANISMS / "slider-crank").simulate("out", laws={"go": stand})

    def test_the_program_says_where_such_a_case_runs(self):
        with self.assertRaisesRegex(blocklift.InputError, "laws are functions of Python"):
            self.hoist().simulate("out")
        self.hoist().validate()

    def test_a_verdict_is_not_lost(self):
        Path("out").mkdir()
        Path("out/summary.json").write_text('{"verdict": "pass"}')
        with self.assertRaisesRegex(blocklift.InputError, "holds the assessment"):
            blocklift.Case("lift").simulate("out", laws={})

    def test_an_assessment_has_the_motion_that_the_laws_make(self):
        case = self.follow(FOLLOW)
        laws = {"follow": lambda time, seen: seen["height"] / 4}
        motion = case.simulate("motion", laws=laws).history("dynamic")
        result = case.assess("assessed", laws=laws, decks=True)
        np.testing.assert_array_equal(result.history("dynamic").tension, motion.tension)
        self.assertIn(result.verdict, ("pass", "fail"))
        self.assertGreater(float(result.envelope().von_mises.max()), 0)
        self.assertTrue(list(Path("assessed").glob("*.inp")))
        # The same of a wish that the program keeps.
        built_in = self.follow({"level": "C1.right", "with": "C1.left", "reaction": "0.5 s",
                                "correction": "4 s"}).assess("built-in")
        self.assertAlmostEqual(result.summary["structure"]["history"]["stress_increase_percent"],
                               built_in.summary["structure"]["history"]["stress_increase_percent"],
                               places=3)

    def test_what_is_raised_on_the_way_to_lengths_of_slings_ends_the_assessment(self):
        class OutOfSight(Exception):
            pass

        def law(time, seen):
            raise OutOfSight("fog")

        with self.assertRaises(OutOfSight):
            self.hoist().assess("out", laws={"go": law})
        self.assertFalse(Path("out/summary.json").exists())

    def study(self, **more):
        self.follow(FOLLOW).save("lift/case.yaml")
        Path("study.yaml").write_text(json.dumps({
            "study": "steered", "case": "lift", "design": "grid",
            "figures": ["ropes.R1.max_dynamic_tension_N"],
            "vary": {"mass": {"keys": ["block:mass"], "values": ["7.8 t", "8 t", "8.2 t"]}},
            **more}))

    def test_members_of_a_study_are_steered(self):
        self.study()
        laws = {"follow": lambda time, seen: seen["height"] / 4}
        members = blocklift.sweep("study.yaml", "swept", laws=laws).members
        self.assertEqual(len(members), 3)
        for mass, figure in zip(("7.8 t", "8 t", "8.2 t"),
                                members["ropes.R1.max_dynamic_tension_N"]):
            shutil.copytree("lift", "alone", dirs_exist_ok=True)
            block = Path("alone/block.yaml")
            block.write_text(block.read_text().replace("mass: 8 t", f"mass: {mass}"))
            alone = blocklift.Case("alone").simulate(files=False, laws=laws)
            tension = alone.history("dynamic").tension.sel(rope="R1")
            self.assertAlmostEqual(float(tension.max()) / figure, 1, places=9)
        self.assertTrue(Path("swept/worst/report.html").is_file())

    def test_a_study_in_this_process_has_the_figures_of_the_program(self):
        Path("study.yaml").write_text(json.dumps({
            "study": "plain", "case": "lift", "design": "grid", "run": "stress",
            "figures": ["ropes.R1.max_dynamic_tension_N",
                        "structure.history.dynamic.checked_von_mises_Pa"],
            "vary": {"mass": {"keys": ["block:mass"], "values": ["7.8 t", "8 t"]}}}))
        theirs = blocklift.sweep("study.yaml", "theirs").members
        ours = blocklift.sweep("study.yaml", "ours", laws={}).members
        for figure in theirs.columns:
            if theirs[figure].dtype == float:
                np.testing.assert_allclose(ours[figure], theirs[figure], rtol=1e-9)

    def test_a_study_with_laws_goes_on_with_nothing(self):
        self.study()
        laws = {"follow": lambda time, seen: seen["height"] / 4}
        blocklift.sweep("study.yaml", "swept", laws=laws)
        with self.assertRaisesRegex(blocklift.InputError, "members of another study"):
            blocklift.sweep("study.yaml", "swept", laws=laws)
        with self.assertRaisesRegex(ValueError, "one member runs at a time"):
            blocklift.sweep("study.yaml", "other", laws=laws, workers=2)

    def test_a_study_without_its_law_runs_nothing(self):
        self.study()
        with self.assertRaisesRegex(blocklift.InputError, 'nobody gives the law "follow"'):
            blocklift.sweep("study.yaml", "swept")
        with self.assertRaisesRegex(blocklift.InputError, 'did you mean "follow"'):
            blocklift.sweep("study.yaml", "swept", laws={"folow": lambda time, seen: 0.0})
        self.assertFalse(Path("swept/members").exists())

    def test_what_a_law_raises_ends_the_study(self):
        self.study()
        raised = KeyError("fog")

        def law(time, seen):
            if seen["height"] > 0.1:
                raise raised
            return 0.0

        with self.assertRaises(KeyError) as caught:
            blocklift.sweep("study.yaml", "swept", laws={"follow": law})
        self.assertIs(caught.exception, raised)

    def test_a_search_is_steered(self):
        self.study(design="search", members=12, minimise="ropes.R1.max_dynamic_tension_N", vary={
            "length": {"keys": ["ropes.R1.length"], "between": ["2.99 m", "3.01 m"]}})
        found = blocklift.sweep("study.yaml", "found",
                                laws={"follow": lambda time, seen: seen["height"] / 4})
        # The longer sling pulls less.
        self.assertAlmostEqual(found.search["variables"]["length"]["value"], 3.01, delta=2e-3)
        self.assertTrue(Path("found/best/report.html").is_file())

    def trolley(self, **keeps):
        """A load that swings under a trolley: 10 m of rod without mass, a ball in 2 degrees."""
        limits = {"speed": "5 m/s", "acceleration": "50 m/s^2", "jerk": "5000 m/s^3",
                  "range": ["-20 m", "20 m"]}
        Path("trolley.yaml").write_text(json.dumps({
            "mechanism": "trolley", "gravity": "9.81 m/s^2",
            "bodies": {"trolley": {"mass": "1 t", "radii_of_gyration": ["1 m", "1 m", "1 m"]},
                       "load": {"mass": "5 t", "radii_of_gyration": ["1 mm", "1 mm", "1 mm"],
                                "centre_of_mass": ["0 m", "0 m", "-10 m"]}},
            "joints": {"rail": {"kind": "prismatic", "child": "trolley", "axis": [1, 0, 0]},
                       "swing": {"kind": "revolute", "parent": "trolley", "child": "load",
                                 "axis": [0, 1, 0]}},
            "drives": {"motor": {"joint": "rail", **limits}},
            "operation": [{"stage": "calm", "moves": [
                {"drives": ["motor"], "duration": "30 s", "keeps": {"reaction": "0 s", **keeps}}]}],
            "initial": {"positions": {"swing": "2 deg"}},
            "simulate": {"duration": "33 s", "relative_tolerance": 1e-9},
            "outputs": {"swing": {"joint": "swing"}, "rail": {"joint": "rail"}}}))
        return blocklift.Case("trolley.yaml")

    def test_a_mechanism_is_steered_too(self):
        # x' = k d, d = the load's place before the trolley's: d'' + k d' + g/L d = 0 for small d.
        k, every = 0.2, 0.01
        ahead = {"from": {"body": "trolley"},
                 "over": {"body": "load", "position": ["0 m", "0 m", "-10 m"]}}
        case = self.trolley(law="calm", every=f"{every} s", sees={"ahead": ahead})
        case.validate()
        result = case.simulate("calm", laws={"calm": lambda time, seen: k * seen["ahead"]})
        swing = result.outputs().swing
        time = swing.time.values
        # Acted on an interval and a half later.
        lag = 1.5 * every
        rates = np.array([1j, -1j])
        for _ in range(20):
            delayed = k * np.exp(-rates * lag)
            rates = -delayed / 2 + np.array([1j, -1j]) * np.sqrt(9.81 / 10 - delayed**2 / 4)
        rate = rates[0]
        # The trolley sets off at once with the speed k d, so that d' begins with -k d.
        due = math.radians(2) * np.exp(rate.real * time) * (
            np.cos(rate.imag * time) + rate.real / rate.imag * np.sin(rate.imag * time))
        np.testing.assert_allclose(swing.values[time < 29], due[time < 29],
                                   atol=math.radians(0.02))
        self.assertLess(abs(float(swing[time < 29][-1])), math.radians(0.15))

    def test_a_mechanism_goes_on_from_where_a_law_left_it(self):
        case = self.trolley(law="go")
        case.data["operation"].append({"stage": "home", "moves": [
            {"drives": ["motor"], "to": "1 m", "speed": "1 m/s"}]})
        case.set("simulate.duration", "40 s")
        result = case.simulate("home", laws={"go": lambda time, seen: 0.1 if time < 10 else 0.0})
        rail = result.outputs().rail
        self.assertAlmostEqual(float(rail.interp(time=25.0)), 1.0, delta=0.03)
        self.assertAlmostEqual(float(rail[-1]), 1.0, places=9)

    def test_wrong_sights_of_a_mechanism_have_their_place(self):
        with self.assertRaisesRegex(blocklift.InputError, 'did you mean "trolley"'):
            self.trolley(law="go", sees={"up": {"level": {"body": "troley"}}}).validate()
        with self.assertRaisesRegex(blocklift.InputError, "two points, over and from"):
            self.trolley(law="go", sees={"up": {"over": {"body": "load"}}}).validate()
        with self.assertRaisesRegex(blocklift.InputError, 'names rope "R1"'):
            self.trolley(law="go", sees={"pull": {"tension": "R1"}}).validate()
        with self.assertRaisesRegex(blocklift.InputError, "does not name its law"):
            self.trolley(every="0.1 s").validate()
        with self.assertRaisesRegex(blocklift.InputError, 'nobody gives the law "go"'):
            self.trolley(law="go").simulate("out")
        with self.assertRaisesRegex(blocklift.InputError, 'nobody gives the law "go"'):
            self.trolley(law="go").simulate("out", laws={})

    def test_without_the_module_it_says_what_to_install(self):
        # A program that has no module beside it, in a process of its own: this one has loaded it.
        program = Path("bin/blocklift")
        program.parent.mkdir()
        program.symlink_to(os.environ["BLOCKLIFT"])
        done = subprocess.run(
            [sys.executable, "-c",
             "import blocklift\ncase = blocklift.Case('lift')\ncase.simulate('theirs')\n"
             "try: case.simulate('ours', laws={})\nexcept ImportError as error: print(error)"],
            env={**os.environ, "BLOCKLIFT": str(program)}, capture_output=True, text=True,
            check=True)
        self.assertIn("pybind11-dev", done.stdout)
        self.assertIn("python3-blocklift", done.stdout)


if __name__ == "__main__":
    unittest.main()
