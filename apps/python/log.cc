// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <memory>
#include <stdexcept>
#include <string>

#include <pybind11/pybind11.h>
#include <spdlog/sinks/sink.h>

#include "apps/python/bindings.h"
#include "apps/python/plain_array.h"
#include "msc_vo/logging/logger.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// A level of the library and its name and number in the Python module logging.
struct Level {
  const char* name;
  spdlog::level::level_enum level;
  int number;
};
constexpr Level kLevels[] = {{"debug", spdlog::level::debug, 10},
                             {"info", spdlog::level::info, 20},
                             {"warning", spdlog::level::warn, 30},
                             {"error", spdlog::level::err, 40},
                             {"off", spdlog::level::off, 50}};

// Hands messages to logging.getLogger("msc_vo"). It has no lock of its own: a thread that held one
// while it waits for the GIL would block those that log with the GIL.
class PythonSink final : public spdlog::sinks::sink {
 public:
  void log(const spdlog::details::log_msg& message) override {
    int number = kLevels[0].number;
    for (const Level& level : kLevels) {
      if (level.level <= message.level) number = level.number;
    }
    const py::gil_scoped_acquire gil;
    try {
      const py::object logger = py::module_::import("logging").attr("getLogger")("msc_vo");
      logger.attr("log")(number, "%s",
                         SystemText({message.payload.data(), message.payload.size()}));
    } catch (py::error_already_set& error) {
      error.discard_as_unraisable("msc_vo: logging");
    }
  }
  void flush() override {}
  void set_pattern(const std::string& /*pattern*/) override {}
  void set_formatter(std::unique_ptr<spdlog::formatter> /*formatter*/) override {}
};

void SetLogLevel(const std::string& name) {
  std::string names;
  for (const Level& level : kLevels) {
    if (name == level.name) return Log().set_level(level.level);
    names += (names.empty() ? "'" : ", '") + std::string(level.name) + "'";
  }
  throw std::invalid_argument("level: must be one of " + names + ", not '" + name + "'");
}

}  // namespace

void BindLog(py::module_* module) {
  Log().sinks() = {std::make_shared<PythonSink>()};
  // Threads of the library may outlive the interpreter's modules.
  py::module_::import("atexit").attr("register")(
      py::cpp_function([] { Log().set_level(spdlog::level::off); }));
  module->def("set_log_level", &SetLogLevel, py::arg("level"),
              "Passes messages of the library to logging.getLogger('msc_vo'): from 'debug' "
              "(keyframes), 'info' (events of a run), 'warning' (weak and lost frames) or 'error' "
              "on; 'off', the default: none.");
}

}  // namespace msc_vo
