// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/deck_results.h>
#include <signorini/application/run_problem.h>

#include <chrono>
#include <thread>

namespace Signorini
{
  ContactModel make_model(const ParameterFile &file, const MPI_Comm communicator, Journal &journal)
  {
    ContactModel model(communicator, file.problem(communicator));
    if (file.deck() != nullptr)
      for (const std::string &text : file.deck()->remarks)
        journal.note(text);
    for (const std::string &text : model.bodies().notes())
      journal.note(text);
    model.note_movement(journal);
    model.refine_globally(file.initial_levels());
    return model;
  }



  NestedSolution solve_problem(ContactModel &model, const ParameterFile &file, const StepObserver &observe,
                               Journal &journal, Checkpoints *const checkpoints)
  {
    NestedSolution nested =
        run_load_steps(model, file.nested(), file.load_steps(), observe, journal, checkpoints);
    if (file.deck() != nullptr)
      judge_linear_kinematics(*file.deck(), model, nested, journal);
    return nested;
  }



  bool all_ranks_come(const MPI_Comm communicator)
  {
    MPI_Request request;
    MPI_Ibarrier(communicator, &request);
    for (unsigned int i = 0; i < 200; ++i)
      {
        int done = 0;
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done)
          return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    return false;
  }
} // namespace Signorini
