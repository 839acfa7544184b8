// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// Call before any file is opened. Opens standard streams that the caller has closed, so that no
/// file gets their descriptors and with them the printed text. Ignores SIGPIPE, so that a closed
/// pipe (`| head -1`) does not end the program before its files are written.
void PrepareStandardStreams();

/// Call after all output. Throws std::runtime_error if standard output could not be written. If the
/// reader of a pipe has closed it, ends the program by SIGPIPE, as is the default.
void FinishStandardOutput();

}  // namespace msc_vo
