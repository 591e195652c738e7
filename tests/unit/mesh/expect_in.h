// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_expect_in_h
#define signorini_tests_expect_in_h

#include <gtest/gtest.h>

#include <string>

/// A test fails where a text has no such part.
inline void
expect_in(const std::string &text, const std::string &part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text << " has no \"" << part << "\"";
}

#endif
