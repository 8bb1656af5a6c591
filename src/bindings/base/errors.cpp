// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/base/errors.hpp"

#include "bindings/bindings.hpp"

void register_errors(nb::module_& module) {
  nb::exception<hdpea::InvalidArgument>(module, "InvalidArgument", PyExc_ValueError);
  nb::exception<hdpea::CannotReconstruct>(module, "CannotReconstruct", PyExc_RuntimeError);
  nb::exception<hdpea::Cancelled>(module, "Cancelled", PyExc_RuntimeError);
}
