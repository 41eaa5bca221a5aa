// Guards read a field as the look-up does.
#include "lookup_access.h"
