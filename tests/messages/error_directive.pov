// mistake in line 4: a scene that stops itself
#declare Size = 3;
#if (Size > 2)
  #error "Size is at most 2\n"
#end
sphere { 0, Size Nonsense }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
