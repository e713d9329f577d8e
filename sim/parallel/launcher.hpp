#pragma once

#include <array>

namespace earshot::parallel {

/// A variable of the environment in which mpirun or a batch system starts a process.
struct LauncherVariable {
  const char* name;
  int least_of_many;  ///< from this value on there are other processes
};

inline constexpr std::array kLauncherVariables{
    LauncherVariable{"OMPI_COMM_WORLD_SIZE", 2},  // OpenMPI's
    LauncherVariable{"PMI_SIZE", 2},              // MPICH's and batch systems'
    LauncherVariable{"PMIX_RANK", 1},             // batch systems'; a rank: of many, the first alone does not show it
};

}  // namespace earshot::parallel
