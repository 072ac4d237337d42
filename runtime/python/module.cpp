#include "bind.hpp"

PYBIND11_MODULE(_zwang, module) {
  module.doc() = "Task files for robots that touch the world: load, simulate, and step them on a robot.";
  zwang::python::bind_language(module);
  zwang::python::bind_log(module);
  zwang::python::bind_loop(module);
  zwang::python::bind_run(module);
  zwang::python::bind_solver(module);
}
