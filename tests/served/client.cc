// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Stands for the program where tests start it: the server (server.cc) that listens at SIGNORINI_SERVER runs
// it with our arguments, environment, working directory and files; we end as it ends.

#include "connection.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{
  bool send_files(const int connection)
  {
    const int    files[3] = {0, 1, 2};
    FilesMessage message;
    cmsghdr     *head = CMSG_FIRSTHDR(&message.head);
    head->cmsg_level  = SOL_SOCKET;
    head->cmsg_type   = SCM_RIGHTS;
    head->cmsg_len    = CMSG_LEN(sizeof(files));
    std::memcpy(CMSG_DATA(head), files, sizeof(files));
    return sendmsg(connection, &message.head, MSG_NOSIGNAL) == 1;
  }
} // namespace



int
main()
{
  const char *const place = std::getenv("SIGNORINI_SERVER");
  sockaddr_un       address;
  if (!place || !set_address(address, place))
    {
      std::fprintf(stderr, "signorini_client: SIGNORINI_SERVER should be the socket of signorini_server.\n");
      return 125;
    }
  const int connection = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int       status;
  if (connect(connection, reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0 ||
      !send_files(connection) || read(connection, &status, sizeof(status)) != sizeof(status))
    {
      std::fprintf(stderr, "signorini_client: no answer of the server\n");
      return 125;
    }
  if (WIFEXITED(status))
    return WEXITSTATUS(status);
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  std::signal(WTERMSIG(status), SIG_DFL);
  std::raise(WTERMSIG(status));
  return 125;
}
