; avr-libc's product, sum and quotient as they are without src/board/float.S.
	.global productOfLibc
productOfLibc:
	call __mulsf3x
	jmp __fp_round

	.global sumOfLibc
sumOfLibc:
	clr r27
	clr r26
	call __addsf3x
	jmp __fp_round

	.global quotientOfLibc
quotientOfLibc:
	call __divsf3x
	jmp __fp_round
