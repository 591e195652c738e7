// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_result_file_h
#define signorini_application_result_file_h

#include <signorini/algebra/input_error.h>

#include <deal.II/base/exceptions.h>

#include <fstream>
#include <string>

namespace Signorini
{
  /// What `writer` writes to a stream, as a file. Errors: InputError if it cannot be written.
  template <typename F>
  void write_file(const std::string &path, const F &writer)
  {
    std::ofstream out(path);
    try
      {
        writer(out);
        out.close();
      }
    catch (const dealii::ExceptionBase &)
      {
        // deal.II looks at the stream, too.
        out.setstate(std::ios::failbit);
      }
    if (!out)
      throw InputError("the file \"" + path + "\" cannot be written: is the disk full?");
  }
} // namespace Signorini

#endif
