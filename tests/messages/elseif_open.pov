// mistake in line 4: an `#elseif` without `)`
#declare I = 1;
#if (I > 1) sphere { 0, 1 }
#elseif (I > 0 sphere { x, 1 }
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
