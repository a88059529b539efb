// Where a corner goes that draws nothing: behind the far plane.
const NOWHERE = vec4f(0.0, 0.0, 2.0, 1.0);
