#pragma once

namespace sward::apps {

/// Whether stderr is a terminal that understands control sequences.
bool stderrIsTerminal();

/// Whether stderr may be coloured: a terminal, and NO_COLOR (no-color.org) is not set.
bool stderrTakesColor();

/// Columns of the terminal at stderr; 80 if unknown.
int stderrColumns();

} // namespace sward::apps
