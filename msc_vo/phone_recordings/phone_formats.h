// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/phone_recordings/folder_sequence.h"

namespace msc_vo {

// The layouts of recordings of telephones, each implemented in a file of its own.

SequenceFormat StrayScannerFormat(const PhoneOptions& options);
SequenceFormat PolycamFormat(const PhoneOptions& options);
SequenceFormat ScannerAppFormat(const PhoneOptions& options);
// Of any camera.
SequenceFormat VideoFolderFormat(const PhoneOptions& options);

}  // namespace msc_vo
