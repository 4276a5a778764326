// doubts in lines 2, 3: words of photons without a value
sphere { 0, 1 pigment { rgb 1 } photons { target refraction } }
sphere { 0, 1 pigment { rgb 1 } photons { target reflection collect } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
