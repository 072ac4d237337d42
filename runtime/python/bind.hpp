/// The Python module `zwang._zwang`: each file binds what one header or two of the rooms say.
#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::python {

/// The content of `zwang.Error`: every diagnostic of a file that cannot be run.
struct LoadError : std::runtime_error {
  explicit LoadError(lang::Diagnostics given);
  lang::Diagnostics diagnostics;
};

void bind_language(pybind11::module_& module);
void bind_loop(pybind11::module_& module);
void bind_log(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_solver(pybind11::module_& module);

}  // namespace zwang::python
