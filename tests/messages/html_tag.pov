// mistakes in lines 2, 4: a tag of HTML
<pre>
sphere { 0, 1 pigment { rgb 1 } }
</pre>
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
