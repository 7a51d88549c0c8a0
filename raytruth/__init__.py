"""raytruth tells whether a ray tracer is right. What this module names is public (docs/python.md); all else is private.

Names are imported only when they are used, so that `import raytruth`, which every module of ours does, costs nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from raytruth.api.images import explain, render, truth
    from raytruth.api.judgement import ImageJudgement, feasible_set, judge
    from raytruth.api.scenes import load_scene, resized
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.comparisons.error_models.ray_offset_model import RayOffset
    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.comparisons.records.results import DeclaredPixels, Verdict, WorstPixel
    from raytruth.comparisons.renderers.program.declaration_file import DeclarationError
    from raytruth.reference_tracer.certified_image import CertifiedImage
    from raytruth.reference_tracer.explanation import ExplanationError
    from raytruth.reference_tracer.explanation_record import Explanation
    from raytruth.scenes.library import library_names
    from raytruth.scenes.loading import SceneError
    from raytruth.scenes.scene import Scene

__all__ = [
    "CertifiedImage",
    "DeclarationError",
    "DeclaredPixels",
    "ErrorModel",
    "Explanation",
    "ExplanationError",
    "FeasibleSet",
    "ImageJudgement",
    "OutputModel",
    "RayOffset",
    "Scene",
    "SceneError",
    "Verdict",
    "WorstPixel",
    "explain",
    "feasible_set",
    "judge",
    "library_names",
    "load_scene",
    "render",
    "resized",
    "truth",
]

_MODULES = {
    "CertifiedImage": "raytruth.reference_tracer.certified_image",
    "DeclarationError": "raytruth.comparisons.renderers.program.declaration_file",
    "DeclaredPixels": "raytruth.comparisons.records.results",
    "ErrorModel": "raytruth.comparisons.error_models.error_model",
    "Explanation": "raytruth.reference_tracer.explanation_record",
    "ExplanationError": "raytruth.reference_tracer.explanation",
    "FeasibleSet": "raytruth.comparisons.feasible_sets.feasible_set",
    "ImageJudgement": "raytruth.api.judgement",
    "OutputModel": "raytruth.comparisons.error_models.output_model",
    "RayOffset": "raytruth.comparisons.error_models.ray_offset_model",
    "Scene": "raytruth.scenes.scene",
    "SceneError": "raytruth.scenes.loading",
    "Verdict": "raytruth.comparisons.records.results",
    "WorstPixel": "raytruth.comparisons.records.results",
    "explain": "raytruth.api.images",
    "feasible_set": "raytruth.api.judgement",
    "judge": "raytruth.api.judgement",
    "library_names": "raytruth.scenes.library",
    "load_scene": "raytruth.api.scenes",
    "render": "raytruth.api.images",
    "resized": "raytruth.api.scenes",
    "truth": "raytruth.api.images",
}
"""Where each public name is defined; the imports above say the same to type checkers."""

if not TYPE_CHECKING:  # to a type checker, a module with `__getattr__` has every name

    def __getattr__(name: str) -> object:
        """The public object of that name, imported when it is first asked for."""
        if name not in _MODULES:
            raise AttributeError(f"module 'raytruth' has no attribute {name!r}")
        from importlib import import_module  # noqa: PLC0415 - not needed by who imports a module of ours

        return getattr(import_module(_MODULES[name]), name)

    def __dir__() -> list[str]:
        """What `dir(raytruth)` lists: the public names, too, although they are not imported yet."""
        return sorted({*globals(), *_MODULES})
