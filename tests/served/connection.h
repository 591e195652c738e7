// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// What the client and the server of the program have in common.

#ifndef signorini_tests_served_connection_h
#define signorini_tests_served_connection_h

#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>

/// The address of a socket in the file system; false if the path is too long for one.
inline bool
set_address(sockaddr_un &address, const char *const path)
{
  address            = {};
  address.sun_family = AF_UNIX;
  if (std::strlen(path) >= sizeof(address.sun_path))
    return false;
  std::strcpy(address.sun_path, path);
  return true;
}

/// A message of one byte with room for standard input, output and error.
struct FilesMessage
{
  FilesMessage()
  {
    head.msg_iov        = &data;
    head.msg_iovlen     = 1;
    head.msg_control    = control;
    head.msg_controllen = sizeof(control);
  }
  FilesMessage(const FilesMessage &) = delete;

  alignas(cmsghdr) char control[CMSG_SPACE(3 * sizeof(int))] = {};
  char   byte                                                = 0;
  iovec  data                                                = {&byte, 1};
  msghdr head                                                = {};
};

#endif
