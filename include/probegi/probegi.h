#pragma once

/// Everything, in pipeline order.
#include "probegi/result.h"
#include "probegi/context.h"
#include "probegi/image.h"
#include "probegi/scene.h"
#include "probegi/io.h"
#include "probegi/builtin_scenes.h"
#include "probegi/tracer.h"
#include "probegi/grid.h"
#include "probegi/field.h"
#include "probegi/render.h"
#include "probegi/reference.h"
#include "probegi/compare.h"
