// mistake in line 2: the source of a web page
sphere { &lt;0, 0, 0&gt;, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
