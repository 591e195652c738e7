// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_mortar_received_bytes_h
#define signorini_tests_mortar_received_bytes_h

#include <cstddef>

/// Bytes that this rank has received from others so far, through whatever function of MPI: the test program
/// puts its own in front of them (the profiling interface of MPI).
std::size_t
received_bytes();

#endif
