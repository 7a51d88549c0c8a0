from __future__ import annotations

import pickle
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.matrix.cell_key import cell_key
from raytruth.comparisons.matrix.kept_versions import kept_version, tried_version
from raytruth.comparisons.records.image_files import write_channels
from raytruth.comparisons.records.renderings import Rays, RendererError
from raytruth.comparisons.renderers.program.first_hit_files import CHANNELS
from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.library import open_scene
from tests.comparisons.renderers.program.scripts import GREY, HEIGHT, WIDTH, grey_scene, program, write_script

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rendering
    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer

pytestmark = pytest.mark.clause("REN-8")

ARGUMENTS = ["{width}", "{height}", "{output}"]


def rendered(renderer: ProgramRenderer, folder: Path, depth: int = 3) -> Rendering:
    folder.mkdir(exist_ok=True)
    scene = grey_scene()
    return renderer.render(scene, "whitted", depth, Rays(*primary_rays(scene)), folder)


def test_the_program_gets_what_its_command_names_and_its_environment(tmp_path: Path) -> None:
    words = ["{scene}", "{depth}", "{seed}", "{samples}", "{folder}"]
    renderer = program(
        tmp_path,
        "write(); scene = sys.argv.pop(4); import json; print(sys.argv[4:], os.environ['SEEN'], os.getcwd())\n"
        "print(json.load(open(scene))['max_depth'])",
        command=["./tracer", *ARGUMENTS, *words],
        environment={"SEEN": "yes"},
    )
    rendering = rendered(renderer, tmp_path / "cell")
    expected = np.broadcast_to(np.float32(GREY), (HEIGHT, WIDTH, 3))
    np.testing.assert_array_equal(rendering.image, expected)
    assert rendering.batch_means is None
    told = (tmp_path / "cell" / "log.txt").read_text().splitlines()
    assert told[1] == f"{['3', '1', '1', str(tmp_path)]} yes {tmp_path / 'cell' / 'program'}"
    assert told[2] == "3"


def test_samples_are_drawn_in_batches_each_with_a_seed_of_its_own(tmp_path: Path) -> None:
    renderer = program(
        tmp_path,
        "write(color=(int(sys.argv[4]), 0.0, 0.0))",
        command=["./tracer", *ARGUMENTS, "{seed}", "{scene}"],
        sampling={"samples": 5, "batches": 8},
    )
    rendering = rendered(renderer, tmp_path / "cell")
    assert renderer.is_stochastic(grey_scene(), "whitted")
    assert rendering.samples == 40
    assert rendering.batch_means is not None
    assert [float(batch[0, 0, 0]) for batch in rendering.batch_means] == list(range(1, 9))
    assert rendering.image is not None
    assert rendering.image[0, 0, 0] == 4.5


def test_a_picture_of_an_earlier_batch_is_not_taken_for_that_of_the_next(tmp_path: Path) -> None:
    code = "write() if sys.argv[4] == '1' else None"
    command = ["./tracer", *ARGUMENTS, "{seed}", "{scene}"]
    renderer = program(tmp_path, code, command=command, sampling={"samples": 5, "batches": 8})
    with pytest.raises(RendererError, match=r"it wrote no output\.pfm; its log ends: last words"):
        rendered(renderer, tmp_path / "cell")


@pytest.mark.clause("VER-9")
def test_first_hits_are_read_where_the_command_asks_for_them(tmp_path: Path) -> None:
    channels = np.arange(HEIGHT * WIDTH * 8, dtype=np.float32).reshape(HEIGHT, WIDTH, 8)
    write_channels(tmp_path / "hits.exr", channels, CHANNELS)
    code = "import shutil; write(); shutil.copy(sys.argv[4], sys.argv[5])"
    command = ["./tracer", *ARGUMENTS, "hits.exr", "{first_hits}", "{scene}"]
    renderer = program(tmp_path, code, command=command, conventions={"flip_x": True})
    assert [integrator.gives for integrator in renderer.integrators] == ["image and first hits"]
    hits = rendered(renderer, tmp_path / "cell").first_hits
    assert hits is not None
    np.testing.assert_array_equal(hits.depth, channels[:, ::-1, 0])
    np.testing.assert_array_equal(hits.position, channels[:, ::-1, 1:4])
    np.testing.assert_array_equal(hits.normal, channels[:, ::-1, 4:7])
    np.testing.assert_array_equal(hits.primitive, channels[:, ::-1, 7])
    write_channels(tmp_path / "hits.exr", channels + np.float32(0.5), CHANNELS)
    with pytest.raises(RendererError, match="expected whole numbers in the channel id"):
        rendered(renderer, tmp_path / "again")
    write_channels(tmp_path / "hits.exr", channels[:, 1:], CHANNELS)
    with pytest.raises(RendererError, match="has 5x4 pixels, expected 6x4"):
        rendered(renderer, tmp_path / "third")


def test_one_that_removes_its_folder_is_an_error(tmp_path: Path) -> None:
    code = "import shutil; shutil.rmtree(os.getcwd())"
    with pytest.raises(RendererError, match="its folder is not as it was made"):
        rendered(program(tmp_path, code), tmp_path / "cell")


@pytest.mark.clause("REN-3")
def test_features_that_are_declared_and_scenes_that_its_format_cannot_say_are_refused(tmp_path: Path) -> None:
    refusing = program(tmp_path, scenes={"refuses": ["spheres"]})
    told = "mine is declared to refuse what the scene requires: spheres"
    assert refusing.refuses(open_scene("single-sphere")) == told
    assert program(tmp_path).refuses(open_scene("single-sphere")) is None
    assert "Mitsuba" in str(program(tmp_path, reads="mitsuba").refuses(open_scene("phong-sphere")))


def test_its_version_is_what_its_command_prints_and_what_it_was_built_as(tmp_path: Path) -> None:
    plain = program(tmp_path)
    assert plain.version() == f"build {plain.digest[:8]}"
    told = program(tmp_path, version=["echo", "tracer\t1.2", "{folder}"])
    assert told.version() == f"tracer1.2 {tmp_path}"[:60] + f", build {told.digest[:8]}"
    assert program(tmp_path, version=["false"]).version() is None


@pytest.mark.clause("REN-10")
def test_a_cell_has_another_key_when_the_program_or_its_declaration_has_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path / "cache"))

    def key(renderer: ProgramRenderer) -> str:
        return cell_key("scene", renderer, renderer.integrators[0], "1")

    first = program(tmp_path)
    tried_version(first)
    assert kept_version(first) == first.version()
    assert key(program(tmp_path)) == key(first)
    assert key(program(tmp_path, numbers="float")) != key(first)
    rebuilt = program(tmp_path, "write()  # built anew")
    assert key(rebuilt) != key(first)
    assert kept_version(rebuilt) is None
    write_script(tmp_path, "write()")
    assert key(program(tmp_path)) == key(first)
    (tmp_path / "sky.glsl").write_text("blue")
    shaded = key(program(tmp_path, files=["*.glsl"]))
    assert key(program(tmp_path, files=["*.glsl"])) == shaded
    (tmp_path / "sky.glsl").write_text("grey")
    assert key(program(tmp_path, files=["*.glsl"])) != shaded


def test_it_travels_to_other_processes(tmp_path: Path) -> None:
    renderer = program(tmp_path)
    assert renderer.digest
    assert pickle.loads(pickle.dumps(renderer)) == renderer
