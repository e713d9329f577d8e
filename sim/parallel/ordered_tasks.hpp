#pragma once

#include <cstddef>
#include <functional>

namespace earshot::parallel {

/// Processors that this process may use, at least 1.
[[nodiscard]] std::size_t available_processors();

/// Groups of equally many independent tasks.
struct TaskGroups {
  std::size_t groups;
  std::size_t tasks_per_group;  ///< >= 1
  std::size_t threads;          ///< >= 1
  std::size_t window;           ///< groups begun before the oldest of them is handed over, >= 1: what bounds the memory
};

/// Does tasks 0, 1, ... on several threads, begun in this order, and hands the groups over on the calling thread in theirs.
///
/// @param work      called with the number of a task, from any thread
/// @param finished  called with the number of a group whose tasks are all done; afterwards the group's room may be used again
/// Throws what the lowest-numbered task that threw has thrown, or what `finished` throws; begun tasks are done by then, others are not
/// begun. Oracle: OrderedTasks.*
void run_in_order(const TaskGroups& groups, const std::function<void(std::size_t task)>& work,
                  const std::function<void(std::size_t group)>& finished);

}  // namespace earshot::parallel
