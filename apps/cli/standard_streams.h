// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

// To be called before any file is opened. Standard streams that the caller has closed are occupied,
// so that no file of ours gets their numbers and with them what is printed. A reader that goes away
// (`| head -1`) does not end the program before its files are written.
void PrepareStandardStreams();

// To be called when all is printed. Throws std::runtime_error if part of it could not be written to
// standard output. If the reader of a pipe has gone away, ends the program as the system ends
// programs that write to such a pipe: without a message, by SIGPIPE.
void FinishStandardOutput();

}  // namespace msc_vo
