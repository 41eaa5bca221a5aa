// Guards read a field by the same functions as the look-up.
#include "lookup_access.h"
