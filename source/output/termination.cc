// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/termination.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <thread>

#include <unistd.h>

namespace Signorini
{
  namespace
  {
    /// Never destroyed: the thread may outlive main().
    struct Guarded
    {
      std::mutex                         mutex;
      std::map<std::string, std::string> message_of;
    };

    Guarded &guarded()
    {
      static auto *const one = new Guarded;
      return *one;
    }

    void remove_guarded(const int signal)
    {
      for (const auto &[folder, message] : guarded().message_of)
        {
          // Other ranks may still be writing there.
          std::error_code error;
          for (unsigned int attempt = 0; attempt < 10; ++attempt)
            {
              std::filesystem::remove_all(folder, error);
              if (!std::filesystem::exists(folder, error))
                break;
              std::this_thread::sleep_for(std::chrono::milliseconds(20));
            }
          if (message.empty())
            continue;
          const std::string text =
              "signorini: ended by signal " + std::to_string(signal) + ": " + message + "\n";
          // Nobody may be there to read it.
          if (write(STDERR_FILENO, text.data(), text.size()) < 0)
            continue;
        }
    }

    /// Waits for one of the signals, cleans up, and ends the process by it.
    void wait_for(const sigset_t signals)
    {
      int signal = 0;
      while (sigwait(&signals, &signal) != 0)
        ;
      const std::lock_guard<std::mutex> lock(guarded().mutex);
      remove_guarded(signal);
      std::signal(signal, SIG_DFL);
      pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
      kill(getpid(), signal);
      // Not before the signal has ended the process may another thread have the folders.
      pause();
    }
  } // namespace



  void TerminationWatch::start()
  {
    // Blocked: libraries may set what happens at a signal.
    sigset_t errors;
    sigemptyset(&errors);
    sigaddset(&errors, SIGPIPE);
    sigaddset(&errors, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &errors, nullptr);
    sigset_t signals;
    sigemptyset(&signals);
    bool any = false;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU})
      {
        // nohup and shells ignore signals for those whom they start.
        struct sigaction present;
        if (sigaction(signal, nullptr, &present) != 0 || present.sa_handler == SIG_IGN)
          continue;
        sigaddset(&signals, signal);
        any = true;
      }
    if (!any)
      return;
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread(wait_for, signals).detach();
  }



  TerminationWatch::Delay::Delay()
    : lock(guarded().mutex)
  {
  }



  void TerminationWatch::guard(const std::string &folder, const std::string &message)
  {
    guard(folder, message, Delay());
  }



  void TerminationWatch::guard(const std::string &folder, const std::string &message, const Delay &)
  {
    guarded().message_of[folder] = message;
  }



  void TerminationWatch::release(const std::string &folder)
  {
    release(folder, Delay());
  }



  void TerminationWatch::release(const std::string &folder, const Delay &)
  {
    guarded().message_of.erase(folder);
  }
} // namespace Signorini
