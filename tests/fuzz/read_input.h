// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_fuzz_read_input_h
#define signorini_tests_fuzz_read_input_h

#include <string>

/// Reads a file as the programs do, and throws away what comes of it. Errors: those of the readers,
/// InputError unless something is wrong with them.
/// @param kind "parameters" and "deck" (as `signorini --check` does), "mesh", or "surface" (as
/// `signorini-map` does, with
///   itself and with a square)
void
read_input(const std::string &kind, const std::string &file);

#endif
