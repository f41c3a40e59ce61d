"""Small trees, each with one breach, which check_rooms must find at its line."""

import pathlib
import tempfile

import check_rooms

ROOMS = "dynamics:\ndynamics/rope: dynamics\npipeline:\npipeline/build: dynamics/rope\n"
TREE = {
    "dynamics/errors.h": "#pragma once\n",
    "dynamics/rope/rope.h": '#pragma once\n#include "dynamics/errors.h"\n',
    "pipeline/version.h": "#pragma once\n",
    "pipeline/build/build.cc": '#include "dynamics/rope/rope.h"\n',
}


def complaints_of(changes, rooms=ROOMS):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**TREE, **changes, ".ci/rooms.txt": rooms}.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return check_rooms.check_tree(root)


def expect(found, *beginnings):
    assert len(found) == len(beginnings), found
    for complaint, beginning in zip(found, beginnings):
        assert beginning in complaint, (complaint, beginning)


expect(complaints_of({}))
expect(complaints_of({"dynamics/rope/rope.h": '#pragma once\n#include "dynamics/errors.h"\n#include "pipeline/version.h"\n'}),
       "dynamics/rope/rope.h:3: error: dynamics/rope may not include pipeline")
expect(complaints_of({"pipeline/build/build.cc": '#include "dynamics/rope/rope.h"\n#include "dynamics/errors.h"\n'}),
       "pipeline/build/build.cc:2: error: pipeline/build may not include dynamics")
expect(complaints_of({"pipeline/build/build.cc": TREE["pipeline/build/build.cc"] + '#include "dynamics/rope/road.h"\n'}),
       "pipeline/build/build.cc:2: error: includes \"dynamics/rope/road.h\", which is not a file")
expect(complaints_of({"dynamics/rope/rope.h": TREE["dynamics/rope/rope.h"] + "#include <deal.II/grid/tria.h>\n"}),
       "dynamics/rope/rope.h:3: error: includes <deal.II/grid/tria.h>, which is for structure")
SOLVER = {"dynamics/simulation/equilibrium.h": "#pragma once\n",
          "pipeline/lift/run.cc": '#include "dynamics/simulation/equilibrium.h"\n'}
LIFT_ROOMS = ROOMS + "dynamics/simulation:\npipeline/lift: dynamics/simulation\n"
expect(complaints_of(SOLVER, LIFT_ROOMS),
       'pipeline/lift/run.cc:1: error: may not include "dynamics/simulation/equilibrium.h": a lift is brought')
expect(complaints_of({"dynamics/attic/thing.h": "#pragma once\n"}),
       "dynamics/attic/thing.h:1: error: the room dynamics/attic does not stand in")
expect(complaints_of({}, ROOMS.replace("dynamics:", "dynamics: pipeline/build")),
       ".ci/rooms.txt:1: error: dynamics may not use pipeline/build", )
expect(complaints_of({}, ROOMS.replace("build:", "build: dynamics")),
       ".ci/rooms.txt: error: pipeline/build is granted dynamics and does not use it")
expect(complaints_of({}, ROOMS + "pipeline/cellar:\n"), "the room pipeline/cellar is empty")
ROPE = "#pragma once\nnamespace lift {\nstruct Rope {\n  int strands;\n};\n}\n"
expect(complaints_of({"dynamics/rope/sling.h": ROPE, "pipeline/version.h": ROPE}),
       "pipeline/version.h:3: error: a second lift::Rope; the first is in dynamics/rope/sling.h:3")
expect(complaints_of({"dynamics/rope/sling.h": ROPE, "pipeline/version.h": ROPE.replace("lift", "report")}))
expect(complaints_of({"dynamics/rope/sling.h": ROPE,
                      "pipeline/build/slings.cc": ROPE.replace("struct", "namespace {\nstruct") + "}\n"}))
expect(complaints_of({"dynamics/rope/sling.h": ROPE.replace("  int strands;", "  struct Wire;"),
                      "dynamics/rope/sling.cc": "namespace lift {\nstruct Rope::Wire {\n};\n}\n"}))
LISTED = {"tests/rope/CMakeLists.txt": "blocklift_test(rope SOURCES rope_test.cc ../steel_test.cc)\n",
          "tests/rope/rope_test.cc": "", "tests/steel_test.cc": ""}
expect(complaints_of(LISTED))
expect(complaints_of({**LISTED, "tests/rope/knot_test.cc": ""}),
       "tests/rope/knot_test.cc:1: error: no CMakeLists.txt names this test")
print("every breach is seen")
