// mistake in line 2: `#define` with parameters
#define SQUARE(X) X*X
sphere { 0, SQUARE(2) }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
