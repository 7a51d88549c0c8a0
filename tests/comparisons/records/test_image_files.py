import subprocess
import sys
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from raytruth.comparisons.records.image_files import ImageError, read_image, write_image
from raytruth.scenes.camera import LARGEST_SIDE

pytestmark = pytest.mark.clause("OUT-1", "RES-1", "RES-2")

SHAPES = st.tuples(st.integers(1, 9), st.integers(1, 9)) | st.tuples(st.integers(1, 9), st.integers(1, 9), st.just(3))
FLOATS = st.floats(width=32, allow_nan=True, allow_infinity=True)


def write_channels(path, width, height, names, change=None):
    spec = OpenImageIO.ImageSpec(width, height, len(names), "float")
    spec.channelnames = names
    if change:
        change(spec)
    output = OpenImageIO.ImageOutput.create(str(path))
    output.open(str(path), spec)
    output.write_image(np.zeros((height, width, len(names)), dtype=np.float32))
    output.close()


@given(image=arrays.arrays(np.float32, SHAPES, elements=FLOATS))
def test_what_is_written_is_read_back_bit_for_bit(tmp_path_factory, image):
    path = tmp_path_factory.mktemp("images") / "image.exr"
    write_image(path, image)
    np.testing.assert_array_equal(read_image(path), image)
    assert read_image(path).shape == image.shape
    assert [entry.name for entry in path.parent.iterdir()] == ["image.exr"]


def test_the_channels_have_the_names_that_viewers_expect(tmp_path):
    for shape, names in (((2, 3), ("Y",)), ((2, 3, 3), ("R", "G", "B"))):
        write_image(tmp_path / "image.exr", np.zeros(shape, dtype=np.float32))
        assert OpenImageIO.ImageInput.open(str(tmp_path / "image.exr")).spec().channelnames == names


@pytest.mark.parametrize("image", [np.zeros((2, 2)), np.zeros((2, 2, 4), np.float32), np.zeros((0, 2), np.float32)])
def test_arrays_of_another_shape_or_type_are_refused_before_anything_is_written(tmp_path, image):
    with pytest.raises(ValueError, match="expected float32"):
        write_image(tmp_path / "image.exr", image)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.clause("OUT-2")
def test_a_write_that_fails_says_so_and_leaves_the_old_file(tmp_path):
    with pytest.raises(ImageError, match="could not be written"):
        write_image(tmp_path / "missing" / "image.exr", np.zeros((2, 2), dtype=np.float32))
    (tmp_path / "taken").mkdir()
    with pytest.raises(ImageError, match="could not be written"):
        write_image(tmp_path / "taken", np.zeros((2, 2), dtype=np.float32))
    assert [entry.name for entry in tmp_path.iterdir()] == ["taken"]


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ImageError, match=r"nowhere\.exr: there is no such image file"):
        read_image(tmp_path / "nowhere.exr")


def test_every_truncation_is_an_error_of_one_line(tmp_path):
    path = tmp_path / "image.exr"
    write_image(path, np.random.default_rng(1).random((9, 11, 3), dtype=np.float32))
    whole = path.read_bytes()
    for length in range(0, len(whole), 41):
        path.write_bytes(whole[:length])
        with pytest.raises(ImageError) as caught:
            read_image(path)
        assert "\n" not in str(caught.value)


def test_bytes_that_are_no_text_in_a_header_give_an_error_and_not_a_decoding_failure(tmp_path):
    path = tmp_path / "image.exr"
    write_image(path, np.zeros((4, 4, 3), dtype=np.float32))
    path.write_bytes(path.read_bytes().replace(b"channels\0", b"chan\xff\xfels\0"))
    with pytest.raises(ImageError):
        read_image(path)


def test_a_png_is_refused_since_its_values_are_not_linear(tmp_path):
    path = tmp_path / "image.png"
    write_channels(path, 2, 2, ("R", "G", "B"))
    with pytest.raises(ImageError, match="expected an OpenEXR image with linear values, found png"):
        read_image(path)


@pytest.mark.parametrize("names", [("R", "G"), ("R", "G", "B", "A"), ("R", "G", "Z")])
def test_other_channels_are_refused_by_name(tmp_path, names):
    write_channels(tmp_path / "image.exr", 2, 2, names)
    with pytest.raises(ImageError, match="expected one channel or R, G and B, found"):
        read_image(tmp_path / "image.exr")


def test_an_image_larger_than_any_scene_is_refused_before_it_is_read(tmp_path):
    write_channels(tmp_path / "image.exr", LARGEST_SIDE + 1, 1, ("Y",))
    with pytest.raises(ImageError, match="expected at most"):
        read_image(tmp_path / "image.exr")


def test_a_cropped_image_is_refused(tmp_path):
    def crop(spec):
        spec.full_width = 5

    write_channels(tmp_path / "image.exr", 2, 2, ("Y",), crop)
    with pytest.raises(ImageError, match="data window equal to the display window"):
        read_image(tmp_path / "image.exr")


def test_a_writer_killed_at_any_time_leaves_no_half_written_image(tmp_path):
    path = tmp_path / "image.exr"
    script = (
        "import sys, pathlib, numpy as np; from raytruth.comparisons.records.image_files import write_image\n"
        "while True: write_image(pathlib.Path(sys.argv[1]), np.ones((64, 64, 3), np.float32)); print('.', flush=True)"
    )
    with subprocess.Popen([sys.executable, "-c", script, path], stdout=subprocess.PIPE, cwd=Path.cwd()) as writer:
        writer.stdout.readline()
        writer.kill()
    np.testing.assert_array_equal(read_image(path), np.ones((64, 64, 3), np.float32))
