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
        with self.assertRaisesRegex(blocklift.InputError, "laws steer drives of lift cases"):
            blocklift.Case(MECHANISMS / "slider-crank").simulate("out", laws={})

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
