// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <exception>
#include <stdexcept>

#include "apps/python/bindings.h"
#include "apps/python/plain_array.h"
#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

py::handle unreadable_image;  // of the module, which is never unloaded

void Raise(py::handle type, const std::exception& error) {
  PyErr_SetObject(type.ptr(), SystemText(error.what()).ptr());
}

// pybind11 itself takes messages for UTF-8, but the paths in them may have any bytes.
void Translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const py::error_already_set&) {
    throw;  // to pybind11, as all that is not caught here
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const UnreadableImage& error) {
    Raise(unreadable_image, error);
  } catch (const std::invalid_argument& error) {
    Raise(PyExc_ValueError, error);
  } catch (const std::runtime_error& error) {
    Raise(PyExc_RuntimeError, error);
  }
}

}  // namespace

void BindErrors(py::module_* module) {
  const py::exception<UnreadableImage> type(*module, "UnreadableImage", PyExc_RuntimeError);
  type.attr("__doc__") =
      "An image of a sequence is missing or damaged; the message names the file.";
  unreadable_image = type;
  py::register_local_exception_translator(&Translate);
}

}  // namespace msc_vo
