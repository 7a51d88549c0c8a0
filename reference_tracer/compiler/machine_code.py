"""From LLVM's IR to an object file for the processor that this runs on (llvmlite: https://llvmlite.readthedocs.io)."""

from __future__ import annotations

import functools
from typing import Any

import llvmlite
from llvmlite import binding

# As much as is worth its time: level 3 makes kernels no quicker.
OPTIMISATION = 2
# In LLVM's units of size, for the operations of arithmetics: with its own 225, kernels of balls take ten times as long
# to compile for code that is a tenth faster; with anything from 25 to 110 they do not.
LARGEST_INLINED = 60


@functools.cache
def processor() -> tuple[str, ...]:
    """What code depends on that is made here: LLVM's version, the processor's name, and what it can do."""
    features = binding.get_host_cpu_features().flatten()
    return llvmlite.__version__, binding.get_process_triple(), binding.get_host_cpu_name(), features


def has_fused_product() -> bool:
    """Whether the processor has an instruction for a·b + c that rounds once: x86 names it, 64-bit ARM always has it."""
    _, triple, _, features = processor()
    return "+fma" in features.split(",") or triple.startswith(("aarch64", "arm64"))


@functools.cache
def target_machine() -> Any:
    """The processor, as LLVM sees it."""
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    _, triple, name, features = processor()
    target = binding.Target.from_triple(triple)
    return target.create_target_machine(name, features, OPTIMISATION, reloc="pic", codemodel="default", jit=True)


def object_code(ir_text: str) -> bytes:
    """An object file of the module. Operations stay as they are written: nothing allows LLVM to contract them."""
    machine = target_machine()
    module = binding.parse_assembly(ir_text)
    module.triple = machine.triple
    module.data_layout = str(machine.target_data)
    module.verify()
    tuning = binding.create_pipeline_tuning_options(speed_level=OPTIMISATION)
    tuning.inlining_threshold = LARGEST_INLINED
    builder = binding.create_pass_builder(machine, tuning)
    builder.getModulePassManager().run(module, builder)
    code: bytes = machine.emit_object(module)
    return code
