// Calls of C++ during which other threads of Python run.
#pragma once

#include <pybind11/pybind11.h>

#include "harness/terminal/interrupt.hpp"

namespace seifbed {

/// Counts the calls that run without the GIL, so that the end of the interpreter can wait for them.
class CallCount {
 public:
  CallCount();
  ~CallCount();
  CallCount(const CallCount&) = delete;
  CallCount& operator=(const CallCount&) = delete;
};

/// Runs without the GIL. Raises SystemExit, which ends the thread, if the interpreter is ending.
class WithoutGil {
 private:
  CallCount counted_;  // until the GIL is back
  pybind11::gil_scoped_release released_;
};

/// What Python does on SIGINT and SIGTERM comes back when the last of these is destroyed: an InterruptGuard leaves the
/// default behind, and then Ctrl-C would end the interpreter.
class PythonSignals {
 public:
  PythonSignals();
  ~PythonSignals();
  PythonSignals(const PythonSignals&) = delete;
  PythonSignals& operator=(const PythonSignals&) = delete;
};

/// A call that Ctrl-C can end: it sets harness::InterruptGuard::flag(). A second Ctrl-C ends the interpreter.
class LongCall {
 private:
  PythonSignals signals_;
  harness::InterruptGuard guard_;
  WithoutGil without_gil_;
};

/// Ends the calls of daemon threads and waits for them, for at most 10 s. A thread that asks for the GIL of an
/// interpreter that is gone would be torn out of C++, which aborts the process.
void end_calls();

}  // namespace seifbed
