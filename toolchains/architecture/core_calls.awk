# Who calls whom in the fixed-memory core, and how much stack each takes: reads what GCC writes with -fcallgraph-info=su,da.
#   awk -v most_stack=32768 -f core_calls.awk a.cpp.ci b.cpp.ci ...
# Names every recursion, every call through a pointer, every array whose size is known at run time only, and a call chain that needs more than
# most_stack bytes; status 1 if there is one. A call through a pointer could lead anywhere: the core has none, so that nothing must be assumed.
BEGIN { FS = "\"" }

function report(text) {
  print text
  found = 1
}

function short(title) {
  return title in says ? says[title] : title
}

# What the callers of a function name where it was compiled several times (firmware/core/wide.hpp), else nothing.
function name_of_clone(title) {
  sub(/^.*:/, "", title)
  return sub(/\.(default|avx2|resolver)$/, "", title) ? title : ""
}

# A constructor that callers name C1 stands under C2, of which it is another name; a destructor likewise.
function defined_as(title,   twin) {
  twin = title
  if (!(title in stack)) gsub(/C1E/, "C2E", twin)
  if (!(twin in stack)) gsub(/D1E/, "D2E", twin)
  return twin in stack ? twin : title
}

function add_call(caller, callee) {
  if ((caller, callee) in known) return
  known[caller, callee] = 1
  callees[caller] = callees[caller] SUBSEP callee
  callers[callee] = callers[callee] SUBSEP caller
  ++open_callees[caller]
  ++open_callers[callee]
}

# A function whose callees are all done is done; its stack is its own and the deepest of theirs.
function finish(title,   i, count, list, deepest) {
  count = split(callees[title], list, SUBSEP)
  for (i = 2; i <= count; ++i)
    if (depth[list[i]] > deepest) {
      deepest = depth[list[i]]
      below[title] = list[i]
    }
  depth[title] = stack[title] + deepest
  count = split(callers[title], list, SUBSEP)
  for (i = 2; i <= count; ++i) if (--open_callees[list[i]] == 0) done[++last] = list[i]
}

/^node: .* bytes \(/ {
  match($4, /[0-9]+ bytes \([a-z,]+\)/)
  usage = substr($4, RSTART, RLENGTH)
  says[$2] = substr($4, 1, index($4, "\\n") - 1)
  if (!($2 in stack) || usage + 0 > stack[$2]) stack[$2] = usage + 0
  if (usage ~ /\(dynamic\)/) report("takes stack of a size known at run time only: " short($2))
  ++functions
}

/^edge:/ { from[++edges] = $2; to[edges] = $4 }

END {
  for (title in stack) if ((clone = name_of_clone(title)) != "") clones[title] = clone
  for (title in clones) {
    stack[clones[title]] += 0
    add_call(clones[title], title)
  }
  for (i = 1; i <= edges; ++i) {
    if (to[i] == "__indirect_call")
      report("calls through a pointer: " short(from[i]))
    else if ((callee = defined_as(to[i])) in stack)
      add_call(from[i], callee)
    else if (callee ~ /^_ZNK?7earshot/)
      report("calls what is no part of the core: " short(from[i]) " calls " callee)
  }
  for (title in stack) if (!open_callees[title]) done[++last] = title
  for (i = 1; i <= last; ++i) finish(done[i])

  # What is not done calls itself by some way, or calls what does: the latter is called by nobody that is not done.
  do {
    stripped = 0
    for (title in stack) {
      if (title in depth || title in only_leads) continue
      called = 0
      count = split(callers[title], list, SUBSEP)
      for (i = 2; i <= count; ++i) if (!(list[i] in depth) && !(list[i] in only_leads)) called = 1
      if (!called) stripped = only_leads[title] = 1
    }
  } while (stripped)
  for (title in stack) if (!(title in depth) && !(title in only_leads)) report("calls itself, directly or by way of others: " short(title))

  if (functions == 0) report("no function to look at")
  for (title in depth) if (depth[title] > depth[deepest]) deepest = title
  for (title = deepest; title != ""; title = below[title]) chain = chain "\n  " stack[title] " " short(title)
  if (depth[deepest] > most_stack) report("needs more stack than " most_stack " bytes: " depth[deepest] chain)
  if (!found) print functions " functions, " edges " calls; the deepest stack is " depth[deepest] " bytes:" chain
  exit found
}
