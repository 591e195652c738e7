// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The program, loaded once: two hundred shared libraries behind deal.II take half a second of processor time
// at each start, and tests start it thousands of times. Each client (client.cc) that connects gets a process
// of its own that is forked here, before MPI begins, with the client's arguments, environment, working
// directory, files, processor affinity and resource limits, and runs the main function of source/main.cc.
// What libraries read of the environment as they are loaded (OMP_NUM_THREADS) is that of the server, and so
// are umask and ignored signals.
//
//   usage: signorini_server SOCKET      writes a line when it listens; ends with its standard input

#include "connection.h"

#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

// The linker's option --wrap=main makes these two of the program's main function.
extern "C" int
__real_main(int argc, char **argv);
extern "C" int
__wrap_main(int argc, char **argv);

namespace
{
  void demand(const bool condition, const char *what)
  {
    if (condition)
      return;
    std::perror(what);
    std::_Exit(125);
  }

  /// The strings of a file of /proc, each ended by a zero byte.
  std::vector<std::string> strings_of(const std::string &path)
  {
    std::ifstream            file(path, std::ios::binary);
    std::vector<std::string> strings;
    for (std::string s; std::getline(file, s, '\0');)
      strings.push_back(s);
    return strings;
  }

  std::vector<char *> pointers_to(std::vector<std::string> &strings)
  {
    std::vector<char *> pointers;
    for (std::string &s : strings)
      pointers.push_back(s.data());
    pointers.push_back(nullptr);
    return pointers;
  }

  /// The client's process.
  pid_t peer(const int connection)
  {
    ucred     credentials;
    socklen_t size = sizeof(credentials);
    demand(getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &credentials, &size) == 0, "SO_PEERCRED");
    return credentials.pid;
  }

  /// Standard input, output and error become those that the client sends.
  void take_files(const int connection)
  {
    FilesMessage message;
    demand(recvmsg(connection, &message.head, 0) == 1, "files of the client");
    const cmsghdr *head = CMSG_FIRSTHDR(&message.head);
    demand(head && head->cmsg_type == SCM_RIGHTS, "files of the client");
    int files[3];
    std::memcpy(files, CMSG_DATA(head), sizeof(files));
    for (int i = 0; i < 3; ++i)
      {
        demand(dup2(files[i], i) == i, "files of the client");
        close(files[i]);
      }
  }

  void take_limits(const pid_t client)
  {
    cpu_set_t processors;
    demand(sched_getaffinity(client, sizeof(processors), &processors) == 0, "affinity");
    demand(sched_setaffinity(0, sizeof(processors), &processors) == 0, "affinity");
    for (int resource = 0; resource < RLIM_NLIMITS; ++resource)
      {
        rlimit     limit;
        const auto kind = static_cast<__rlimit_resource>(resource);
        demand(prlimit(client, kind, nullptr, &limit) == 0, "limits");
        demand(setrlimit(kind, &limit) == 0, "limits");
      }
  }

  /// Does not return.
  void run_program(const int connection)
  {
    const pid_t       client = peer(connection);
    const std::string place  = "/proc/" + std::to_string(client);
    take_files(connection);
    close(connection);
    demand(chdir((place + "/cwd").c_str()) == 0, "working directory");
    static std::vector<std::string> arguments = strings_of(place + "/cmdline"),
                                    variables = strings_of(place + "/environ");
    clearenv();
    for (std::string &variable : variables)
      putenv(variable.data());
    take_limits(client);
    std::signal(SIGCHLD, SIG_DFL);
    std::vector<char *> argv = pointers_to(arguments);
    std::exit(__real_main(static_cast<int>(arguments.size()), argv.data()));
  }

  /// Waits for the program's end and tells it the client; a client that goes away takes the program along.
  void serve(const int connection)
  {
    std::signal(SIGCHLD, SIG_DFL);
    const pid_t program = fork();
    demand(program >= 0, "fork");
    if (program == 0)
      run_program(connection);
    const int end = static_cast<int>(syscall(SYS_pidfd_open, program, 0));
    if (end < 0)
      kill(program, SIGKILL);
    demand(end >= 0, "pidfd_open");
    // Of the client only its end is to be noticed: what it sends is the program's to read.
    pollfd events[2] = {{end, POLLIN, 0}, {connection, 0, 0}};
    while (poll(events, 2, -1) < 0)
      ;
    if (!events[0].revents)
      kill(program, SIGKILL);
    int status;
    demand(waitpid(program, &status, 0) == program, "waitpid");
    demand(events[1].revents || write(connection, &status, sizeof(status)) == sizeof(status), "exit status");
    std::_Exit(0);
  }
} // namespace



extern "C" int
__wrap_main(int argc, char **argv)
{
  std::signal(SIGCHLD, SIG_IGN);
  sockaddr_un address;
  if (argc != 2 || !set_address(address, argv[1]))
    {
      std::fprintf(stderr, "usage: signorini_server SOCKET\n");
      return 2;
    }
  const int listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  demand(bind(listener, reinterpret_cast<const sockaddr *>(&address), sizeof(address)) == 0, argv[1]);
  demand(listen(listener, 64) == 0, argv[1]);
  std::puts("listening");
  std::fflush(stdout);
  pollfd events[2] = {{listener, POLLIN, 0}, {STDIN_FILENO, 0, 0}};
  while (!events[1].revents)
    {
      if (poll(events, 2, -1) < 0 || !events[0].revents)
        continue;
      const int connection = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
      if (connection < 0)
        continue;
      const pid_t child = fork();
      if (child < 0)
        std::perror("fork");
      if (child == 0)
        {
          close(listener);
          serve(connection);
        }
      close(connection);
    }
  return 0;
}
