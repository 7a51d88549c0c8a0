"""From typed Python functions to machine code, pass by pass.

1. `names.py`: which function a name stands for, and where its text is.
2. `typer.py`, `typed_expressions.py`, `overloads.py`: the forward pass, from Python's syntax tree to the typed tree
   (`typed_tree.py`, `types.py`).
3. `lowering.py`, `lowered_expressions.py`, `machine_operations.py`: from the typed tree to LLVM's IR.
4. `machine_code.py`: LLVM's passes, and the object file.
5. `object_files.py`, `dependencies.py`: object files kept on disk, and what they depend on.
6. `loading.py`: linked into this process, and called.

`compilation.py` is all of them in a row; `questions.py` is what compiled code asks of a call, and tells it;
`exact_errors.py` is what takes one instruction where the processor has it.
"""
