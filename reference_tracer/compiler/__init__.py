"""From typed Python functions to machine code: types, typed tree, lowering to LLVM's IR, object files, calls."""
