"""The Python package on the small lift, through the program that was built."""

import json
import os
import pickle
import shutil
import signal
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import blocklift
from small_lift import MECHANISMS, VESSELS, InATemporaryFolder


class CaseTest(InATemporaryFolder):
    def test_reads_and_changes_values_by_their_keys(self):
        case = blocklift.Case("lift")
        self.assertEqual(case.name, "small-lift")
        self.assertEqual(case.get("ropes.R1.to"), "L1")
        self.assertEqual(case.get("operation[0].stage"), case.data["operation"][0]["stage"])
        with self.assertRaisesRegex(KeyError, 'did you mean "ropes"'):
            case.get("rope.R1.length")
        with self.assertRaisesRegex(KeyError, r"there is no \[77\]"):
            case.get("operation[77].stage")
        with self.assertRaisesRegex(KeyError, "there are no keys"):
            case.set("title.of", "it")

    def test_a_changed_case_runs_from_a_copy_without_earlier_results(self):
        from blocklift.case import _left_out

        for name in ("first", "models", ".cache", "results"):
            Path(name).mkdir()
        Path("first/summary.json").touch()
        Path("first/results.h5").touch()
        Path("models/summary.json").touch()
        self.assertEqual(sorted(_left_out(".", sorted(os.listdir()))),
                         [".cache", "first", "results"])

    def test_saves_what_was_changed_and_keeps_comments(self):
        text = Path("lift/case.yaml").read_text(encoding="utf-8")
        Path("lift/case.yaml").write_text("# of the yard\n" + text, encoding="utf-8")
        case = blocklift.Case("lift")
        case.set("title", "Another lift")
        case.save("lift/other.yaml")
        saved = Path("lift/other.yaml").read_text(encoding="utf-8")
        self.assertTrue(saved.startswith("# of the yard\n"))
        self.assertEqual(blocklift.Case("lift/other.yaml").get("title"), "Another lift")
        blocklift.Case("lift/other.yaml").validate()

    def test_complains_with_file_and_line(self):
        case = blocklift.Case("lift")
        case.validate()
        case.set("ropes.R1.to", "L11")
        with self.assertRaises(blocklift.InputError) as caught:
            case.validate()
        complaint = caught.exception.complaints[0]
        self.assertEqual(complaint.file, str(case.file))
        self.assertIn("L11", complaint.message)
        line = Path("lift/case.yaml").read_text(encoding="utf-8").splitlines()[complaint.line - 1]
        self.assertIn("R1", line)
        self.assertTrue(complaint.hints)
        Path("lift/case.yaml").write_text("case: [", encoding="utf-8")
        with self.assertRaises(blocklift.InputError):
            blocklift.Case("lift")

    def test_a_key_that_is_none_changes_nothing(self):
        case = blocklift.Case("lift")
        before = list(case.data["operation"])
        for key in ("operation[-1]", "operation[x].stage", "operation[0", "ropes..R1", "", "."):
            with self.assertRaisesRegex(KeyError, "is no key"):
                case.set(key, "1 m")
            with self.assertRaisesRegex(KeyError, "is no key"):
                case.get(key)
        self.assertEqual(list(case.data["operation"]), before)

    def test_numbers_of_numpy_are_numbers(self):
        case = blocklift.Case("lift")
        case.set("checks.rope_safety_factor", np.linspace(4, 6, 3)[1])
        case.set("title", np.str_("Another"))
        case.set("load.position", tuple(f"{x} m" for x in np.array([-2.0, 4.5, 1.5])))
        case.set("operation[0]", {"stage": "hoist", "pause": "1 s", "moves": [
            {"drives": ["C1.left"], "by": "-1 m"}]})
        case.validate()
        self.assertEqual(blocklift.Case(case.save("lift/other.yaml")).get(
            "checks.rope_safety_factor"), 5)

    def test_keys_of_models_are_set_as_in_their_files(self):
        block = Path("lift/block.yaml").read_text(encoding="utf-8")
        case = blocklift.Case("lift")
        case.set("block:mass", "9 t")
        case.set("block:plates.sides.at[1]", "3.0 m")  # lists count from 0, as in all of Python
        case.set("gantry:hoists.left.hook_block.mass", "400 kg")
        self.assertEqual(case.get("block:mass"), "9 t")
        case.validate()
        by_key = case.simulate("by-key").history("static").tension
        self.assertEqual(Path("lift/block.yaml").read_text(encoding="utf-8"), block)
        for file, old, new in (("block.yaml", "mass: 8 t", "mass: 9 t"),
                               ("gantry/crane.yaml", "mass: 300 kg, wind", "mass: 400 kg, wind")):
            path = Path("lift") / file
            path.write_text(path.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
        by_file = blocklift.Case("lift").simulate("by-file").history("static").tension
        np.testing.assert_array_equal(by_key, by_file)

    def test_keys_of_models_that_cannot_be_set(self):
        case = blocklift.Case("lift")
        for key in (":mass", "block:", "block:[0]", "block:plates..sides"):
            with self.assertRaisesRegex(KeyError, "is no key"):
                case.set(key, "9 t")
        with self.assertRaisesRegex(TypeError, "takes one value"):
            case.set("block:centre_of_mass", ["2 m", "1.5 m", "1 m"])
        with self.assertRaisesRegex(KeyError, "was not set"):
            case.get("block:mass")
        for key, hint in (("block:mas", 'did you mean "mass"'), ("blok:mass", "block"),
                          ("block:plates.sides.at[2]", "has 2 items")):
            case.model_values.clear()
            case.set(key, "9 t")
            with self.assertRaises(blocklift.InputError) as caught:
                case.validate()
            complaint = caught.exception.complaints[0]
            self.assertTrue(complaint.file.startswith("--set "), complaint)
            self.assertIn(hint, " ".join(complaint.hints))
        with self.assertRaisesRegex(ValueError, "not in the file of the case"):
            case.save("lift/other.yaml")
        self.assertFalse(Path("lift/other.yaml").exists())

    def test_a_file_without_keys(self):
        for text in ("", "- a\n- b\n", "word\n"):
            Path("lift/case.yaml").write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(blocklift.InputError, "the file has no keys"):
                blocklift.Case("lift")

    def test_complaints_name_the_models_of_the_case_and_not_those_of_a_copy(self):
        block = Path("lift/block.yaml")
        block.write_text(block.read_text().replace("mass: 8 t", "mass: -8 t"), encoding="utf-8")
        case = blocklift.Case("lift")
        case.set("title", "changed, so that a copy of its folder is run")
        with self.assertRaises(blocklift.InputError) as caught:
            case.validate()
        self.assertEqual(caught.exception.complaints[0].file, str(block))
        self.assertTrue(Path(caught.exception.complaints[0].file).is_file())

    def test_complaints_come_over_from_other_processes(self):
        error = blocklift.InputError([blocklift.Complaint("case.yaml", 3, 7, "wrong", ["a", "b"])])
        again = pickle.loads(pickle.dumps(error))
        self.assertIsInstance(again, blocklift.InputError)
        self.assertEqual(again.complaints, error.complaints)
        self.assertEqual(str(again), str(error))

    def test_threads_read_cases_side_by_side(self):
        alone = blocklift.Case("lift").data
        with ThreadPoolExecutor(8) as threads:
            for data in threads.map(lambda _: blocklift.Case("lift").data, range(40)):
                self.assertEqual(data, alone)

    def test_ctrl_c_ends_the_program(self):
        case = blocklift.Case("lift")
        case.set("settle", "20000 s")
        # What runs in the background may ignore it.
        self.addCleanup(signal.signal, signal.SIGINT,
                        signal.signal(signal.SIGINT, signal.default_int_handler))
        timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            case.simulate("out")
        self.assertLess(time.monotonic() - begin, 10)
        self.assertFalse(Path("out").exists())

    def test_a_file_that_is_not_there(self):
        with self.assertRaises(FileNotFoundError):
            blocklift.Case("nowhere")
        with self.assertRaises(FileNotFoundError):
            blocklift.Result("lift")


class ResultTest(InATemporaryFolder):
    def test_a_simulation_in_memory_leaves_no_folder(self):
        kept = blocklift.Case("lift").simulate(files=False)
        self.assertFalse(kept.folder.exists())
        self.assertEqual(os.listdir(), ["lift"])
        written = blocklift.Case("lift").simulate("out")
        self.assertTrue(kept.history().identical(written.history()))
        self.assertTrue(kept.ropes.equals(written.ropes))
        self.assertIn("in memory", repr(kept))
        with self.assertRaisesRegex(ValueError, "output names a folder"):
            blocklift.Case("lift").simulate("out", files=False)

    def test_an_assessment_as_arrays(self):
        result = blocklift.Case("lift").assess("out")
        self.assertTrue(result.passed)
        self.assertTrue(0 < result.stress_increase < 0.2)
        motion = result.history("dynamic")
        self.assertEqual(list(motion.rope.values), ["R1", "R2", "R3", "R4"])
        self.assertEqual(motion.tension.attrs["units"], "N")
        # The summary's largest tension is that of the history.
        for rope, row in result.ropes.iterrows():
            self.assertAlmostEqual(float(motion.tension.sel(rope=rope).max()),
                                   row["max_dynamic_tension_N"], delta=1e-6)
        # Velocities are the slopes of the places.
        height = motion.pose.sel(body="load", coordinate="z")
        slope = np.gradient(height.values, motion.time.values)
        speed = motion.velocity.sel(body="load", component="z").values
        self.assertLess(np.abs(slope - speed)[2:-2].max(), 0.02 * np.abs(speed).max())
        self.assertEqual(result.to_dataframe().shape, (motion.sizes["time"], 4))
        self.assertIn("utilisation", result.checks)
        surface = result.surface()
        self.assertEqual(surface["points"].shape[1], 3)
        self.assertLess(surface["quads"].max(), len(surface["points"]))
        self.assertEqual(len(surface["dynamic"]), len(surface["points"]))
        self.check_stress(result)
        self.check_unit_responses(result)
        with self.assertRaises(KeyError):
            result.history("yesterday")
        with self.assertRaises(KeyError):
            result.outputs()

    def check_stress(self, result):
        assessed = result.summary["structure"]["history"]
        for state in ("static", "dynamic"):
            envelope = result.envelope(state)
            largest = envelope.isel(square=int(envelope.von_mises.argmax()))
            theirs = assessed[state]
            self.assertAlmostEqual(float(largest.von_mises) / theirs["checked_von_mises_Pa"], 1,
                                   places=9)
            self.assertAlmostEqual(float(largest.time), theirs["time_s"])
            np.testing.assert_allclose(largest.centre, theirs["checked_point_m"], atol=1e-9)
            self.assertIn(str(largest.plate.values), theirs["checked_group"])
            self.assertIn(str(largest.rope.values), ["R1", "R2", "R3", "R4"])
            # What is followed at the hot spot reaches the envelope there.
            hot = result.stress(state).von_mises.sel(place="hot spot")
            self.assertLessEqual(float(hot.max()), float(envelope.von_mises.max()) * (1 + 1e-9))
        self.assertAlmostEqual(float(hot.max() / largest.von_mises), 1, places=9)
        tilt = result.measures()["load: tilt"]
        self.assertEqual(tilt.attrs["units"], "rad")
        peak = next(one for one in result.summary["measures"] if one["name"] == "load: tilt")
        self.assertAlmostEqual(float(tilt.max()), peak["dynamic"], places=12)
        self.assertAlmostEqual(float(tilt.time[int(tilt.argmax())]), peak["time_of_dynamic_s"])
        axes = result.plot_stress()
        self.assertEqual(axes.get_zlabel(), "z, m")
        for missing in (result.envelope, result.stress, result.measures, result.load_factors):
            with self.assertRaises(KeyError):
                missing("yesterday")

    def check_unit_responses(self, result):
        responses = result.unit_responses()
        self.assertEqual(responses.stress.attrs["units"], "Pa")
        for state in ("static", "dynamic"):
            factors = result.load_factors(state)
            self.assertEqual(list(factors.unit_load.values),
                             list(responses.unit_load.values))
            # Superposed they are the stress that was followed at these places.
            stress = responses.stress @ factors
            xx, yy, zz, xy, yz, zx = (stress.sel(component=one) for one in responses.component)
            von_mises = np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2
                                + 3 * (xy ** 2 + yz ** 2 + zx ** 2))
            followed = result.stress(state).von_mises
            self.assertEqual(list(followed.place.values), ["hot spot", "L1", "L2", "L3", "L4"])
            there = von_mises.sel(place=followed.place).transpose(*followed.dims)
            np.testing.assert_allclose(there, followed, rtol=1e-9)
            # Each lug has one rope, whose tension is the force on its pin.
            for lug, rope in (("L1", "R1"), ("L4", "R4")):
                force = factors.sel(unit_load=[f"{lug} {axis}" for axis in "xyz"])
                self.assertEqual(set(force.unit.values), {"N"})
                tension = result.history(state).tension.sel(rope=rope)
                np.testing.assert_allclose(np.linalg.norm(force, axis=1), tension, rtol=1e-9)

    def test_a_changed_case_gives_other_loads_and_leaves_the_file_alone(self):
        before = Path("lift/case.yaml").read_text(encoding="utf-8")
        case = blocklift.Case("lift")
        calm = case.simulate("calm").history("static").tension.isel(time=0)
        for stage in range(len(case.data["ropes"])):
            name = list(case.data["ropes"])[stage]
            case.set(f"ropes.{name}.length", case.get(f"ropes.{name}.length"))
        case.set("gravity", "19.6133 m/s^2")
        heavy = case.simulate("heavy").history("static").tension.isel(time=0)
        ratio = float(heavy.sum() / calm.sum())
        self.assertAlmostEqual(ratio, 2, delta=0.02)
        self.assertEqual(Path("lift/case.yaml").read_text(encoding="utf-8"), before)

    def test_a_lift_that_fails_is_a_result(self):
        case = blocklift.Case("lift")
        case.set("checks.rope_safety_factor", 1000)
        result = case.assess("out")
        self.assertFalse(result.passed)
        self.assertEqual(result.verdict, "fail")

    def test_files_of_different_runs_are_refused(self):
        case = blocklift.Case("lift")
        case.simulate("one")
        case.simulate("two")
        shutil.copy("one/summary.json", "two/summary.json")
        with self.assertRaisesRegex(ValueError, "different runs"):
            blocklift.Result("two")

    def test_a_mechanism(self):
        result = blocklift.Case(MECHANISMS / "slider-crank").simulate("crank")
        outputs = result.outputs()
        # A crank of 0.2 m and a rod of 0.5 m.
        self.assertAlmostEqual(float(outputs.slider.max() - outputs.slider.min()), 0.4, places=3)
        with self.assertRaises(ValueError):
            result.passed

    def test_draws(self):
        import matplotlib

        matplotlib.use("Agg")
        result = blocklift.Case("lift").simulate("out")
        axes = result.plot_tensions()
        self.assertEqual(len(axes.lines), 4)
        self.assertEqual(axes.get_ylabel(), "tension, t")
        self.assertEqual(result.plot_path("load").get_ylabel(), "way of load, m")
        with self.assertRaises(KeyError):
            result.plot_path("roof")

    def test_tables_of_any_variable(self):
        result = blocklift.Case("lift").simulate("out")
        frame = result.to_dataframe()
        self.assertEqual(list(frame.columns), ["R1", "R2", "R3", "R4"])
        self.assertEqual(frame.index.name, "time")
        poses = result.to_dataframe(variable="pose")
        self.assertIn(("load", "z"), poses.columns)
        self.assertEqual(len(result.natural_periods[0]["modes"]), 16)
        with self.assertRaises(KeyError):
            result.to_dataframe(variable="mood")


class DescribeTest(InATemporaryFolder):
    def test_keys_are_explained_by_their_declarations(self):
        case = blocklift.Case("lift")
        self.assertIn("default: 9.80665 m/s^2", case.describe("gravity"))
        self.assertIn("length", case.describe("ropes.R1"))
        self.assertIn("moves", case.describe("operation[0]"))
        with self.assertRaisesRegex(KeyError, 'did you mean "gravity"'):
            case.describe("gravitas")
        self.assertIn("joints", blocklift.describe("mechanism"))
        with self.assertRaisesRegex(ValueError, "lift case"):
            blocklift.describe("novel")


class StudyTest(InATemporaryFolder):
    def test_a_study_as_tables(self):
        Path("study.yaml").write_text(
            "study: weight\ncase: lift\nmembers: 12\nvary:\n"
            "  weight: {keys: ['block:mass'], spread: {law: uniform, lowest: 7 t, highest: 9 t}}\n",
            encoding="utf-8")
        study = blocklift.sweep("study.yaml", "out", workers=2)
        members = study.members
        self.assertEqual(len(members), 12)
        # At rest the ropes carry the weight alone.
        ratio = members["ropes.R1.max_static_tension_N"] / members["weight (kg)"]
        self.assertLess(ratio.std() / ratio.mean(), 0.002)
        largest = study.spreads.loc["ropes.R1.max_static_tension_N"]
        self.assertEqual(members["weight (kg)"].idxmax(), largest.member_of_largest)
        self.assertEqual(list(study.worst.history("dynamic").rope.values), ["R1", "R2", "R3", "R4"])
        # The weight decides alone.
        figure = "ropes.R1.max_static_tension_N"
        self.assertEqual(study.correlations.loc[figure, "weight"], 1)
        median = study.quantiles.loc[(figure, 0.5)]
        self.assertAlmostEqual(median.value, members[figure].median(), delta=1e-6 * median.value)
        self.assertTrue(median.low < median.value < median.high)
        # Of 2 t the middle 90 %.
        swing = study.swings.loc[(figure, "weight")]
        self.assertAlmostEqual(swing["to"] - swing["from"], 1800, places=6)
        self.assertAlmostEqual(swing.swing, ratio.mean() * 1800, delta=0.01 * swing.swing)
        self.assertTrue(swing.low < swing.swing < swing.high)
        axes = study.plot_tornado(figure)
        self.assertEqual(axes.get_xlabel(), f"swing of {figure}")
        self.assertAlmostEqual(axes.patches[0].get_width(), swing.swing)
        with self.assertRaises(KeyError):
            study.plot_tornado("ropes.R9.max_static_tension_N")
        self.assertEqual(len(study.sobol_indices), 0)
        self.assertRegex(repr(study), r"^<Study \w+, \d+ members, 0 failed, out>$")
        for other in ("limits", "search", "best"):
            with self.assertRaises(KeyError):
                getattr(study, other)

    def test_failed_members_are_warned_of(self):
        study = self.set_down()
        Path("grid.yaml").write_text(study + "design: grid\n", encoding="utf-8")
        with self.assertRaisesRegex(blocklift.RunError, "member 1 failed: stage .* waits for R1"):
            blocklift.sweep("grid.yaml", "grid", workers=1)
        grid = blocklift.Study("grid")
        self.assertEqual(len(grid.summary["failures"]), 1)
        self.assertEqual(len(grid.quantiles), 0)
        Path("half.yaml").write_text(study + "members: 4\n", encoding="utf-8")
        with self.assertRaisesRegex(blocklift.RunError, "2 of 4 members failed"):
            blocklift.sweep("half.yaml", "half", workers=1)
        self.assertEqual(len(blocklift.Study("half").members), 4)

    def test_a_study_without_a_common_figure(self):
        Path("study.json").write_text(json.dumps({"study": "s", "members": 2, "failures": [],
                                                  "figures": []}))
        study = blocklift.Study(".")
        for table in (study.spreads, study.quantiles, study.extremes, study.correlations):
            self.assertEqual(len(table), 0)
        with self.assertRaisesRegex(KeyError, "no figure"):
            study.plot_tornado()

    def test_sobol_indices(self):
        Path("study.yaml").write_text(
            "study: two\ncase: lift\ndesign: sensitivity\nmembers: 8\n"
            "figures: [ropes.R1.max_static_tension_N]\nvary:\n"
            "  weight: {keys: ['block:mass'], spread: {law: uniform, lowest: 7 t, highest: 9 t}}\n"
            "  R1: {keys: [ropes.R1.length],"
            " spread: {law: uniform, lowest: 2.999 m, highest: 3.001 m}}\n",
            encoding="utf-8")
        indices = blocklift.sweep("study.yaml", "out", workers=2).sobol_indices
        total = indices.total.loc["ropes.R1.max_static_tension_N"]
        self.assertGreater(total["weight"], 0.9)
        self.assertLess(total["R1"], 0.1)

    def test_limiting_seas(self):
        states = [{"peak_period_s": period, "heading_rad": heading, "known_as": "interpolated",
                   "significant_height_m": 0.1 * period + heading, "governed_by": "swing",
                   "alpha": 0.8}
                  for period in (5.0, 8.0) for heading in (0.0, 1.5)]
        states[0].update(significant_height_m=None, alpha=None, known_as="unknown")
        Path("study.json").write_text(
            json.dumps({"figures": [], "limits": {"alpha": 1, "sea_states": states}}))
        limits = blocklift.Study(".").limits
        self.assertAlmostEqual(float(limits.height.sel(heading=1.5, period=8)), 2.3)
        self.assertTrue(np.isnan(limits.height.sel(heading=0, period=5)))
        self.assertTrue(np.isnan(limits.alpha.sel(heading=0, period=5)))
        self.assertEqual(float(limits.alpha.sel(heading=1.5, period=5)), 0.8)
        self.assertEqual(limits.height.attrs["units"], "m")
        self.assertEqual(str(limits.governed_by.sel(heading=0, period=5).values), "swing")

    def test_a_search(self):
        Path("search.yaml").write_text(
            "study: level\ncase: lift\ndesign: search\nmembers: 14\n"
            "minimise: 'measures.load: tilt.static'\nvary:\n"
            "  pair: {keys: [ropes.R1.length, ropes.R3.length], between: [2.9 m, 3.2 m]}\n",
            encoding="utf-8")
        study = blocklift.sweep("search.yaml", "out", workers=2)
        found = study.search
        self.assertTrue(found["is_feasible"])
        tilts = study.members["measures.load: tilt.static"]
        self.assertEqual(found["member"], tilts.idxmin())
        self.assertAlmostEqual(float(study.best.measures("static")["load: tilt"].max()),
                               found["value"], places=9)
        with self.assertRaises(FileNotFoundError):
            study.worst


class MeasuredTest(InATemporaryFolder):
    def test_finds_clock_scale_and_weight(self):
        result = blocklift.Case("lift").simulate("out")
        table = result.to_dataframe()
        # R1's cell shows 4 % too much, and the clock is that of a day.
        table["R1"] *= 1.04
        table.index = table.index + 36000
        table.columns = [f"ropes.{rope} [N]" for rope in table.columns]
        table.to_csv("cells.csv", index_label="time [s]")
        found = blocklift.measured(result, "cells.csv", rest=(0, 18), cell_accuracy=0.005,
                                   page="page.html")
        self.assertAlmostEqual(found.shifts["cells.csv"], -36000, places=3)
        self.assertAlmostEqual(found.channels.loc["ropes.R1", "scale"], 1.04, places=4)
        self.assertAlmostEqual(found.channels.loc["ropes.R2", "scale"], 1, places=4)
        self.assertEqual(found.doubts, [])
        self.assertAlmostEqual(found.weight["mass_kg"] / 8000, 1.01, delta=0.005)
        self.assertTrue(Path("page.html").is_file())
        given = blocklift.measured("out", ["cells.csv"], shifts=-36000, window=(2, 10))
        self.assertEqual(given.shifts["cells.csv"], -36000)
        self.assertIsNone(given.weight)
        # A window that begins before the lift is none of the program's options.
        early = blocklift.measured("out", "cells.csv", shifts=np.float32(-36000),
                                   window=(-5, np.float64(10)))
        self.assertEqual(early.shifts["cells.csv"], -36000)
        with self.assertRaises(blocklift.InputError):
            blocklift.measured("out", "missing.csv")
        table["ropes.R2 [N]"] = -table["ropes.R2 [N]"]
        table.to_csv("cells.csv", index_label="time [s]")
        with self.assertWarnsRegex(blocklift.LiftWarning, "R2 .* its sign may be reversed"):
            blocklift.measured("out", "cells.csv", shifts=-36000)


class NewCaseTest(InATemporaryFolder):
    def test_writes_a_case_to_begin_with(self):
        self.assertEqual(blocklift.new("two-hoists", "box"), Path("box"))
        case = blocklift.Case("box")
        case.validate()
        self.assertEqual(case.name, "box")
        with self.assertRaisesRegex(blocklift.InputError, "is there already"):
            blocklift.new("two-hoists", "box")
        with self.assertRaisesRegex(ValueError, "two-hoists"):
            blocklift.new("two-hoist", "other")
        self.assertFalse(Path("other").exists())


class HullTest(InATemporaryFolder):
    def test_a_database_by_frequency_mode_and_heading(self):
        sphere = VESSELS / "sphere-5m/vessel.yaml"
        database = blocklift.hydro(sphere, "sphere.h5")
        self.assertEqual(len(database.draughts), 1)
        state = database.state()
        self.assertEqual(state.added_mass.dims, ("frequency", "mode", "motion"))
        self.assertEqual(state.frequency.attrs["units"], "rad s-1")
        self.assertEqual(state.excitation.dims, ("frequency", "mode", "heading"))
        # Haskind's relation of a body of revolution in deep water: B = k |X|^2 / (4 rho g c), c the
        # waves' group velocity g / (2 omega). Where most is sent out, within 3 %.
        rho, g = 1000.0, 9.80665
        heave = state.sel(mode="heave").sel(heading=0.0)
        damping = heave.damping.sel(motion="heave")
        omega = state.frequency
        by_waves = omega**2 / g * abs(heave.excitation) ** 2 / (4 * rho * g * g / (2 * omega))
        self.assertLess(float(abs(by_waves - damping).max() / damping.max()), 0.03)
        with self.assertRaisesRegex(IndexError, "from 0 to 0, and 1 is none"):
            database.state(1)
        with self.assertRaises(blocklift.InputError):
            blocklift.hydro(sphere.with_name("no.yaml"), "none.h5")
        with self.assertRaises(FileNotFoundError):
            blocklift.Hydrodynamics("none.h5")


class ProgramTest(unittest.TestCase):
    def test_knows_its_version_and_the_schema(self):
        self.assertRegex(blocklift.version(), r"^\d+\.\d+")
        self.assertIn("properties", str(blocklift.schema("case")))


if __name__ == "__main__":
    unittest.main()
